#include "target/image_structure.h"

#include <cctype>
#include <cmath>
#include <set>

#include "target/file_numbers.h"
#include "target/image_header.h"

namespace telestrain {
namespace {

constexpr std::string_view kPngBegin = "\x89PNG\r\n\x1A\n";
// What one byte of a file can unpack to at the most: bytes of zlib; bytes of TIFF's LZW, whose
// codes of 12 bit stand for 4093 bytes at the longest; pixels of a JPEG, of whose blocks of 64 each
// takes a bit.
constexpr double kMostDeflated = 1032, kMostLzw = 2729, kMostJpeg_px = 512;

std::string BreaksOff(std::size_t at, const std::string& part) {
  return "breaks off at byte " + std::to_string(at) + ", in " + part;
}

std::string TooShort(std::string_view bytes, const ImageSize& size) {
  return "has " + std::to_string(bytes.size()) + " bytes, too few for the " +
         std::to_string(size.width_px) + " x " + std::to_string(size.height_px) +
         " px that its header states";
}

// Bytes of one row of pixels; not whole numbers, since those of a lie may overflow.
double RowBytes(double width_px, double bits) { return std::ceil(width_px * bits / 8); }

std::string PngFault(std::string_view bytes, const ImageSize& size) {
  if (Unsigned(bytes, 8, 4, true) != 13 || bytes.substr(12, 4) != "IHDR")
    return "does not begin with a PNG header";
  double data = 0;
  for (std::size_t at = kPngBegin.size();;) {
    if (bytes.size() - at < 12) return BreaksOff(bytes.size(), "its chunks, before the last one");
    const std::size_t length = Unsigned(bytes, at, 4, true);
    const std::string_view name = bytes.substr(at + 4, 4);
    for (const char c : name)
      if (std::isalpha(static_cast<unsigned char>(c)) == 0)
        return "is damaged at byte " + std::to_string(at) + ", where a chunk should begin";
    if (length > bytes.size() - at - 12)
      return BreaksOff(bytes.size(),
                       "chunk " + std::string(name) + " of byte " + std::to_string(at));
    if (name == "acTL") return "is an animation (chunk acTL at byte " + std::to_string(at) + ")";
    if (name == "IDAT") data += static_cast<double>(length);
    if (name == "IEND") break;
    at += 12 + length;
  }
  const double depth = Unsigned(bytes, 24, 1, true);
  const double wanted = RowBytes(double(size.width_px), depth) * double(size.height_px);
  return wanted > kMostDeflated * data ? TooShort(bytes, size) : "";
}

// From a start of scan to the next marker; stuffed bytes and restarts belong to the scan.
std::size_t EndOfScan(std::string_view bytes, std::size_t at) {
  for (; at + 1 < bytes.size(); ++at) {
    const auto next = static_cast<unsigned char>(bytes[at + 1]);
    if (bytes[at] == '\xFF' && next != 0 && next != 0xFF && (next < 0xD0 || next > 0xD7)) return at;
  }
  return bytes.size();
}

// A thumbnail inside has an end of its own, so that the segments must be followed.
std::string JpegFault(std::string_view bytes, const ImageSize& size) {
  if (double(size.width_px) * double(size.height_px) > kMostJpeg_px * double(bytes.size()))
    return TooShort(bytes, size);
  for (std::size_t at = 2; at + 3 < bytes.size() || bytes.substr(at, 2) == "\xFF\xD9";) {
    if (bytes[at] != '\xFF')
      return "is damaged at byte " + std::to_string(at) + ", where a segment should begin";
    const auto marker = static_cast<unsigned char>(bytes[at + 1]);
    if (marker == 0xD9) return "";
    if (marker == 0xFF) {
      ++at;
      continue;
    }
    at += 2 + std::size_t{Unsigned(bytes, at + 2, 2, true)};
    if (at >= bytes.size()) break;
    if (marker == 0xDA) at = EndOfScan(bytes, at);
    if (at >= bytes.size()) break;
  }
  return BreaksOff(bytes.size(), "its segments, before the end of the image");
}

std::string BmpFault(std::string_view bytes, const ImageSize& size) {
  const std::uint32_t compression = Unsigned(bytes, 30, 4, false);
  if (compression != 0 && compression != 3) return "is a compressed BMP";
  const long long bits = Unsigned(bytes, 28, 2, false);
  if (bits != 1 && bits != 4 && bits != 8 && bits != 16 && bits != 24 && bits != 32)
    return "has " + std::to_string(bits) + " bit a pixel";
  const double row = 4 * std::ceil(RowBytes(double(size.width_px), double(bits)) / 4);
  const double wanted = Unsigned(bytes, 10, 4, false) + row * double(size.height_px);
  return wanted > double(bytes.size()) ? TooShort(bytes, size) : "";
}

// P1 to P3 are numbers in text: a digit at least for each, the larger ones parted.
std::string PnmFault(std::string_view bytes, const ImageSize& size) {
  const char kind = bytes[1];
  const double samples = kind == '3' || kind == '6' ? 3 : 1;
  const double bits = kind == '1' ? 8 : kind == '4' ? 1 : kind == '5' || kind == '6' ? 8 : 16;
  const double wanted = RowBytes(double(size.width_px) * samples, bits) * double(size.height_px);
  return wanted > double(bytes.size()) ? TooShort(bytes, size) : "";
}

// What of the first directory says how much memory its pixels take, and where the second one is.
struct TiffFacts {
  long long samples = 1, bits = 1, compression = 1, tile_width = 0, tile_length = 0;
};

TiffFacts FactsOf(std::string_view bytes, std::size_t directory, std::uint32_t count, bool big) {
  TiffFacts facts;
  std::set<std::uint32_t> seen;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t entry = directory + 2 + 12 * i;
    const std::uint32_t tag = Unsigned(bytes, entry, 2, big);
    if (!seen.insert(tag).second) continue;  // libtiff takes the first
    const bool is_short = Unsigned(bytes, entry + 2, 2, big) == kTiffShort;
    // More than two shorts, one for each sample, stand elsewhere; the first is like the others.
    const bool is_elsewhere = is_short && Unsigned(bytes, entry + 4, 4, big) > 2;
    const std::size_t place = is_elsewhere ? Unsigned(bytes, entry + 8, 4, big) : entry + 8;
    const long long value = Unsigned(bytes, place, is_short ? 2 : 4, big);
    if (tag == 258) facts.bits = value;
    if (tag == 259) facts.compression = value;
    if (tag == 277) facts.samples = value;
    if (tag == 322) facts.tile_width = value;
    if (tag == 323) facts.tile_length = value;
  }
  return facts;
}

// A second directory of a reduced image is a preview of the first one.
bool IsPreview(std::string_view bytes, std::size_t directory, bool big) {
  const std::uint32_t count = Unsigned(bytes, directory, 2, big);
  for (std::size_t i = 0; i < count; ++i)
    if (Unsigned(bytes, directory + 2 + 12 * i, 2, big) == 254)
      return (Unsigned(bytes, directory + 10 + 12 * i, 4, big) & 1) != 0;
  return false;
}

std::string TiffFault(std::string_view bytes, const ImageSize& size) {
  constexpr long long kTileBeyond_px = 1024;  // tiles reach beyond the border
  constexpr long long kMostSamples = 4, kMostBits = 16;
  const bool big = bytes[0] == 'M';
  const std::size_t directory = Unsigned(bytes, 4, 4, big);
  const std::uint32_t count = Unsigned(bytes, directory, 2, big);
  const std::size_t end = directory + 2 + std::size_t{12} * count;
  if (end + 4 > bytes.size()) return BreaksOff(bytes.size(), "its directory");
  const TiffFacts facts = FactsOf(bytes, directory, count, big);
  if (facts.samples > kMostSamples || facts.bits > kMostBits)
    return "has " + std::to_string(facts.samples) + " samples of " + std::to_string(facts.bits) +
           " bit a pixel";
  if (facts.tile_width > size.width_px + kTileBeyond_px ||
      facts.tile_length > size.height_px + kTileBeyond_px)
    return "has tiles of " + std::to_string(facts.tile_width) + " x " +
           std::to_string(facts.tile_length) + " px, larger than itself";
  const double wanted =
      RowBytes(double(size.width_px), double(facts.bits)) * double(size.height_px);
  if (wanted > double(bytes.size()) * (facts.compression == 1 ? 1 : kMostLzw))
    return TooShort(bytes, size);
  constexpr int kMostPreviews = 16;  // a list may lead back into itself
  std::size_t next = Unsigned(bytes, end, 4, big);
  for (int previews = 0; next != 0; ++previews) {
    if (previews == kMostPreviews || !IsPreview(bytes, next, big))
      return "is one of several in the file (another begins at byte " + std::to_string(next) + ")";
    next = Unsigned(bytes, next + 2 + std::size_t{12} * Unsigned(bytes, next, 2, big), 4, big);
  }
  return "";
}

}  // namespace

std::string StructureFault(std::string_view bytes) {
  const auto size = SizeFromHeader(bytes);
  if (!size) return "has no header that is known";
  if (bytes.starts_with(kPngBegin)) return PngFault(bytes, *size);
  if (bytes.starts_with("\xFF\xD8")) return JpegFault(bytes, *size);
  if (bytes.starts_with("BM")) return BmpFault(bytes, *size);
  if (bytes.starts_with("P")) return PnmFault(bytes, *size);
  return TiffFault(bytes, *size);
}

}  // namespace telestrain
