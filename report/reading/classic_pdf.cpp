#include "report/reading/classic_pdf.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <string_view>

namespace telestrain {
namespace {

constexpr std::size_t kTailBytes = 200;      // holds "startxref NUMBER %%EOF"
constexpr std::size_t kMostRevisions = 100;  // four signatures and their time stamps need ten

bool IsBlank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '\0'; }

void SkipBlanks(std::string_view& text) {
  while (!text.empty() && IsBlank(text.front())) text.remove_prefix(1);
}

bool Take(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

std::optional<std::size_t> TakeNumber(std::string_view& text) {
  SkipBlanks(text);
  std::size_t number = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failed != std::errc()) return {};
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

std::optional<std::size_t> LastTable(std::string_view bytes) {
  std::string_view tail = bytes.substr(bytes.size() - std::min(bytes.size(), kTailBytes));
  const std::size_t at = tail.rfind("startxref");
  if (at == std::string_view::npos) return {};
  tail.remove_prefix(at);
  Take(tail, "startxref");
  const auto offset = TakeNumber(tail);
  SkipBlanks(tail);
  if (!Take(tail, "%%EOF")) return {};
  SkipBlanks(tail);
  return tail.empty() ? offset : std::nullopt;
}

// The trailer's text behind the table at `offset`; nothing when there is no plain table.
std::optional<std::string_view> TrailerAt(std::string_view bytes, std::size_t offset) {
  if (offset >= bytes.size()) return {};
  std::string_view text = bytes.substr(offset);
  if (!Take(text, "xref")) return {};
  const std::size_t end = text.find_first_not_of("0123456789nf \r\n");
  if (end == std::string_view::npos) return {};
  text.remove_prefix(end);
  const std::size_t stop = text.find("startxref");
  if (stop == std::string_view::npos || !Take(text, "trailer")) return {};
  return text.substr(0, stop - std::string_view("trailer").size());
}

std::size_t Count(std::string_view text, std::string_view word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) ++count;
  return count;
}

// One dictionary without strings in brackets, comments or escaped names, so that its words are what
// they look like.
bool IsPlain(std::string_view trailer) {
  return Count(trailer, "<<") == 1 && trailer.find_first_of("#%()") == trailer.npos &&
         Count(trailer, "/Prev") <= 1;
}

}  // namespace

std::string WhyNotClassicPdf(const std::string& bytes) {
  if (!bytes.starts_with("%PDF-")) return "it does not begin as a PDF does";
  std::optional<std::size_t> offset = LastTable(bytes);
  if (!offset) return "it does not end as a PDF does";
  std::set<std::size_t> seen;
  while (offset) {
    if (!seen.insert(*offset).second || seen.size() > kMostRevisions)
      return "its cross-reference tables have no end";
    const auto trailer = TrailerAt(bytes, *offset);
    if (!trailer) return "it has a place without a plain cross-reference table, which ours have";
    if (!IsPlain(*trailer) || trailer->find("/XRefStm") != trailer->npos)
      return "its trailer is not as ours are";
    const std::size_t at = trailer->find("/Prev");
    offset.reset();
    if (at == trailer->npos) continue;
    std::string_view rest = trailer->substr(at + 5);
    offset = TakeNumber(rest);
    if (!offset) return "its trailer is not as ours are";
  }
  return "";
}

}  // namespace telestrain
