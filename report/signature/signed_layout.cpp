#include "report/signature/signed_layout.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <optional>

#include "report/signature/roles.h"

namespace telestrain {
namespace {

constexpr std::string_view kRange = "/ByteRange [";
constexpr std::string_view kContents = "]\n/Contents ";
constexpr std::string_view kEndObject = "\nendobj\n";
constexpr std::string_view kTableHead = "xref\n0 1\n0000000000 65535 f \n";
constexpr std::size_t kRangeWidth = 46;  // "0" and three numbers of up to 14 digits

std::string ObjectHead(int number) { return std::to_string(number) + " 0 obj\n"; }

// Reads a text piece by piece; once something is not as wanted, all that follows fails.
class Scanner {
 public:
  Scanner(std::string_view text, std::size_t at) : text_(text), at_(at), ok_(at <= text.size()) {}
  bool Skip(std::string_view wanted) {
    ok_ = ok_ && text_.substr(at_, wanted.size()) == wanted;
    if (ok_) at_ += wanted.size();
    return ok_;
  }
  bool Sees(std::string_view wanted) const {
    return ok_ && text_.substr(at_, wanted.size()) == wanted;
  }
  std::size_t Number() {
    std::size_t number = 0;
    const char* begin = text_.data() + at_;
    if (!ok_) return 0;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), number);
    ok_ = error == std::errc();
    at_ += static_cast<std::size_t>(end - begin);
    return number;
  }
  std::string Until(std::string_view mark) {
    const std::size_t end = ok_ ? text_.find(mark, at_) : std::string_view::npos;
    ok_ = end != std::string_view::npos;
    if (!ok_) return "";
    std::string piece(text_.substr(at_, end - at_));
    at_ = end + mark.size();
    return piece;
  }
  bool ok() const { return ok_; }
  std::size_t at() const { return at_; }

 private:
  std::string_view text_;
  std::size_t at_;
  bool ok_;
};

// The tail of the update that these bytes end with. What is read is written again and compared, so
// that there is nothing in it that this reader passes over.
std::optional<UpdateTail> ReadTail(std::string_view bytes, std::size_t table) {
  Scanner scan(bytes, table);
  scan.Skip(kTableHead);
  UpdateTail tail;
  while (scan.ok() && !scan.Sees("trailer")) {
    const auto number = static_cast<int>(scan.Number());
    scan.Skip(" 1\n");
    tail.offsets[number] = scan.Number();
    scan.Skip(" 00000 n \n");
  }
  scan.Skip("trailer\n<< /Size ");
  tail.size = static_cast<int>(scan.Number());
  scan.Skip(" /Root ");
  tail.root = scan.Until(" /");
  if (scan.Sees("Info ")) {
    scan.Skip("Info ");
    tail.info = scan.Until(" /");
  }
  scan.Skip("Prev ");
  tail.previous = scan.Number();
  scan.Skip(" /ID [<");
  tail.first_id = scan.Until("><");
  tail.second_id = scan.Until(">]");
  if (!scan.ok() || bytes.substr(table) != TailText(tail, table)) return std::nullopt;
  return tail;
}

// The objects follow one another from the update's first byte to its table.
bool ObjectsAreWithoutGap(std::string_view bytes, const UpdateTail& tail, std::size_t table) {
  std::vector<std::pair<std::size_t, int>> order;
  for (const auto& [number, offset] : tail.offsets) order.emplace_back(offset, number);
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t end = i + 1 < order.size() ? order[i + 1].first : table;
    if (order[i].first >= end || end > table) return false;
    const auto object = bytes.substr(order[i].first, end - order[i].first);
    if (!object.starts_with(ObjectHead(order[i].second)) || !object.ends_with(kEndObject))
      return false;
    // A stream's data may hold any bytes.
    const std::size_t first_end = object.find(kEndObject) + kEndObject.size();
    if (first_end != object.size() &&
        object.substr(0, first_end).find("\nstream\n") == std::string_view::npos)
      return false;
  }
  return !order.empty();
}

// The role of the field that the update fills in; the field's object stands in it as text.
std::string RoleIn(std::string_view update, std::size_t index) {
  for (const std::string_view role : kSigningRoles)
    if (update.find("/T (" + std::string(role) + ")") != std::string_view::npos)
      return std::string(role);
  return "signature " + std::to_string(index + 1);
}

// ByteRange and Contents at `at`; nothing unless they are written as MakeSignatureRoom does and
// cover all of the file but the Contents.
std::optional<RawSignature> ReadSignature(std::string_view bytes, std::size_t at) {
  Scanner scan(bytes, at);
  scan.Skip(kRange);
  const std::size_t range = scan.at();
  scan.Skip("0 ");
  RawSignature signature;
  signature.gap_begin = scan.Number();
  scan.Skip(" ");
  signature.gap_end = scan.Number();
  scan.Skip(" ");
  signature.end = signature.gap_end + scan.Number();
  if (!scan.ok() || signature.end > bytes.size() || signature.gap_end < 1 ||
      signature.gap_begin >= signature.gap_end ||
      bytes.substr(range, kRangeWidth) !=
          ByteRangeText(signature.gap_begin, signature.gap_end, signature.end))
    return std::nullopt;
  Scanner after(bytes, range + kRangeWidth);
  if (!after.Skip(kContents) || after.at() != signature.gap_begin || !after.Skip("<") ||
      bytes[signature.gap_end - 1] != '>' ||
      bytes.substr(signature.gap_end, 11) != "\n>>\nendobj\n")
    return std::nullopt;
  const auto hex =
      bytes.substr(signature.gap_begin + 1, signature.gap_end - signature.gap_begin - 2);
  if (hex.find_first_not_of("0123456789abcdef") != std::string_view::npos) return std::nullopt;
  return signature;
}

// Fills in what the update says; false when it is not as updates are.
bool ReadUpdate(std::string_view bytes, RawSignature* signature) {
  const auto whole = bytes.substr(0, signature->end);
  const std::size_t table = LastTable(whole);
  const auto tail = table ? ReadTail(whole, table) : std::nullopt;
  if (!tail || !ObjectsAreWithoutGap(whole, *tail, table)) return false;
  const auto by_offset = [](const auto& a, const auto& b) { return a.second < b.second; };
  const auto [first, last] =
      std::minmax_element(tail->offsets.begin(), tail->offsets.end(), by_offset);
  if (last->second >= signature->gap_begin || table <= signature->gap_end) return false;
  signature->begin = first->second;
  signature->object = last->first;
  const auto before = bytes.substr(0, signature->begin);
  Scanner scan(whole.substr(last->second), 0);
  scan.Skip(ObjectHead(signature->object));
  scan.Skip("<< ");
  if (!scan.Skip(kSignatureHead)) return false;
  signature->claimed_time = scan.Until(")");
  return LastTable(before) == tail->previous && tail->previous != 0;
}

}  // namespace

std::string TailText(const UpdateTail& tail, std::size_t begin) {
  std::string text(kTableHead);
  for (const auto& [number, offset] : tail.offsets) {
    char line[32];
    std::snprintf(line, sizeof line, "%010zu 00000 n \n", offset);
    text += std::to_string(number) + " 1\n" + line;
  }
  text += "trailer\n<< /Size " + std::to_string(tail.size) + " /Root " + tail.root;
  if (!tail.info.empty()) text += " /Info " + tail.info;
  return text + " /Prev " + std::to_string(tail.previous) + " /ID [<" + tail.first_id + "><" +
         tail.second_id + ">] >>\nstartxref\n" + std::to_string(begin) + "\n%%EOF\n";
}

std::string ObjectText(int number, std::string_view content) {
  return ObjectHead(number).append(content).append(kEndObject);
}

SignatureRoom MakeSignatureRoom(int number, const std::string& entries, std::size_t reserve_bytes) {
  const std::string head = "<< " + entries + "\n" + std::string(kRange);
  const std::string gap = "<" + std::string(2 * reserve_bytes, '0') + ">";
  SignatureRoom room;
  room.text = ObjectText(
      number, head + std::string(kRangeWidth, ' ') + std::string(kContents) + gap + "\n>>");
  room.range_begin = ObjectHead(number).size() + head.size();
  room.gap_begin = room.range_begin + kRangeWidth + kContents.size();
  room.gap_end = room.gap_begin + gap.size();
  return room;
}

std::string ByteRangeText(std::size_t gap_begin, std::size_t gap_end, std::size_t end) {
  std::string text = "0 " + std::to_string(gap_begin) + " " + std::to_string(gap_end) + " " +
                     std::to_string(end - gap_end);
  text.resize(std::max(text.size(), kRangeWidth), ' ');
  return text;
}

std::size_t LastTable(std::string_view bytes) {
  constexpr std::string_view kStart = "startxref\n";
  const std::size_t start = bytes.rfind(kStart);
  if (start == std::string_view::npos) return 0;
  Scanner scan(bytes, start + kStart.size());
  const std::size_t table = scan.Number();
  if (!scan.Skip("\n%%EOF\n") || scan.at() != bytes.size() || table >= start) return 0;
  return bytes.substr(table, 5) == "xref\n" ? table : 0;
}

SignedLayout ReadSignedLayout(std::string_view bytes) {
  SignedLayout layout;
  std::size_t covered = 0;
  for (std::size_t at = bytes.find(kRange); at != std::string_view::npos;
       at = bytes.find(kRange, at + 1)) {
    const std::size_t index = layout.signatures.size();
    auto signature = ReadSignature(bytes, at);
    if (!signature || !ReadUpdate(bytes, &*signature)) {
      const std::string role =
          RoleIn(bytes.substr(covered, bytes.find("\nendobj", at) - covered), index);
      layout.failure = role + ": its signature or the update it came with was changed";
      return layout;
    }
    if (covered != 0 && signature->begin != covered) {
      layout.failure = layout.signatures.back().role + ": bytes were added after its signature";
      return layout;
    }
    signature->role =
        RoleIn(bytes.substr(signature->begin, signature->end - signature->begin), index);
    covered = signature->end;
    layout.signatures.push_back(*signature);
  }
  if (!layout.signatures.empty() && covered != bytes.size())
    layout.failure = layout.signatures.back().role +
                     ": the last signature does not cover the last " +
                     std::to_string(bytes.size() - covered) + " bytes of the file";
  // What is left of a signature whose ByteRange is spelled otherwise.
  if (layout.signatures.empty() && (bytes.find("/ByteRange") != std::string_view::npos ||
                                    bytes.find("ETSI.CAdES") != std::string_view::npos))
    layout.failure = "the file has a signature that is not as telestrain writes it";
  return layout;
}

}  // namespace telestrain
