#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace telestrain {

// The bytes of a signed PDF: what was written first, then one incremental update per signature
// (ISO 32000-1, 7.5.6). Read without a PDF library, so that there is one reading of them: an update
// is objects without a gap, their cross-reference table and a trailer, in exactly the text below.

// The end of an update.
struct UpdateTail {
  std::map<int, std::size_t> offsets;  // of the objects, by number
  int size = 0;                        // one more than the highest number of the file
  std::string root, info;              // "5 0 R"; info may be empty
  std::size_t previous = 0;            // where the cross-reference table before is
  std::string first_id, second_id;     // hex
};
std::string TailText(const UpdateTail& tail, std::size_t begin);

// The text of an object, "7 0 obj\n…\nendobj\n".
std::string ObjectText(int number, std::string_view content);

// What every signature's value begins with; its time as PdfTime and the other entries follow.
inline constexpr std::string_view kSignatureHead =
    "/Type /Sig /Filter /Adobe.PPKLite /SubFilter /ETSI.CAdES.detached\n/M (";

// The signature's value. `entries` is what stands before ByteRange: kSignatureHead first, texts of
// the signer only in hex, so that they hold no text that has a meaning here.
struct SignatureRoom {
  std::string text;             // of the object, with a ByteRange of blanks
  std::size_t range_begin = 0;  // in `text`
  std::size_t gap_begin = 0, gap_end = 0;
};
SignatureRoom MakeSignatureRoom(int number, const std::string& entries, std::size_t reserve_bytes);
// The numbers of ByteRange, as wide as the room for them.
std::string ByteRangeText(std::size_t gap_begin, std::size_t gap_end, std::size_t end);

struct RawSignature {
  int object = 0;                          // number of the signature's value
  std::size_t begin = 0, end = 0;          // of its update
  std::size_t gap_begin = 0, gap_end = 0;  // Contents with < and >
  std::string role;                        // "signature 2" when it cannot be read off
  std::string claimed_time;                // as PDF writes it
};

struct SignedLayout {
  std::vector<RawSignature> signatures;  // in the order of the file
  std::string failure;                   // empty when the file is laid out like this
};
SignedLayout ReadSignedLayout(std::string_view bytes);

// Where the last cross-reference table of these bytes begins; 0 when they do not end with one in
// plain text.
std::size_t LastTable(std::string_view bytes);

}  // namespace telestrain
