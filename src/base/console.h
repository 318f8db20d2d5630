#pragma once

#include <mutex>
#include <ostream>
#include <string>

namespace telestrain {

// Where a command talks to the person: results on `out`, everything else on `err`. Names that come
// from files may stand in a line: what would move the cursor is written as \xNN (PrintableText).
class Console {
 public:
  // `show_progress` draws a progress bar on `err`; pass whether it is a terminal.
  Console(std::ostream& out, std::ostream& err, bool show_progress);

  void Say(const std::string& line);   // one line of result
  void Note(const std::string& line);  // one line of side information
  void Warn(const std::string& line);  // one line, marked as a warning

  // 0, or the errno of the first line of result that could not be written.
  int OutError() const { return out_error_; }

  // Redraws the bar "label [####----] done/total"; ends the line when done == total. Thread-safe.
  void Progress(const std::string& label, int done, int total);

 private:
  void ClearBar();

  // Streams of our own on the buffers of those given: a library's reader may point std::cerr
  // elsewhere for a while.
  std::ostream out_;
  std::ostream err_;
  bool show_progress_;
  bool bar_on_screen_ = false;
  int out_error_ = 0;
  std::mutex mutex_;
};

}  // namespace telestrain
