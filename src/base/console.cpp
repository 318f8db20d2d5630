#include "base/console.h"

#include <algorithm>
#include <cerrno>
#include <string_view>

#include "base/utf8.h"

namespace telestrain {

namespace {

// Keeps line feeds: what is said may be a table.
std::string PrintableLines(const std::string& text) {
  std::string printable;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (begin > 0) printable += '\n';
    printable += PrintableText(std::string_view(text).substr(begin, end - begin));
    begin = end + 1;
  }
  return printable;
}

}  // namespace

Console::Console(std::ostream& out, std::ostream& err, bool show_progress)
    : out_(out.rdbuf()), err_(err.rdbuf()), show_progress_(show_progress) {}

void Console::ClearBar() {
  if (!bar_on_screen_) return;
  err_ << "\r\x1b[K" << std::flush;
  bar_on_screen_ = false;
}

void Console::Say(const std::string& line) {
  const std::lock_guard lock(mutex_);
  ClearBar();
  errno = 0;
  out_ << PrintableLines(line) << '\n' << std::flush;
  if (!out_ && out_error_ == 0) out_error_ = errno != 0 ? errno : EIO;
}

void Console::Note(const std::string& line) {
  const std::lock_guard lock(mutex_);
  ClearBar();
  err_ << PrintableText(line) << '\n' << std::flush;
}

void Console::Warn(const std::string& line) { Note("warning: " + line); }

void Console::Progress(const std::string& label, int done, int total) {
  if (!show_progress_ || total <= 0) return;
  const std::lock_guard lock(mutex_);
  constexpr int kWidth = 32;
  const int filled = std::clamp(kWidth * done / total, 0, kWidth);
  err_ << "\r\x1b[K" << label << " [" << std::string(static_cast<std::size_t>(filled), '#')
       << std::string(static_cast<std::size_t>(kWidth - filled), '-') << "] " << done << '/'
       << total << std::flush;
  bar_on_screen_ = true;
  if (done >= total) ClearBar();
}

}  // namespace telestrain
