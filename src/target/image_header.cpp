#include "target/image_header.h"

#include <cctype>
#include <cstdlib>

#include "target/file_numbers.h"

namespace telestrain {
namespace {

using namespace std::string_view_literals;

std::optional<ImageSize> BmpSize(std::string_view bytes) {
  const auto height = static_cast<int>(Unsigned(bytes, 22, 4, false));
  return ImageSize{Unsigned(bytes, 18, 4, false), std::llabs(height)};  // top-down if negative
}

// "P5 width height ...", with comments from '#' to the line's end. A number ends with white space:
// of "1#6 12" readers make different numbers.
std::optional<ImageSize> PnmSize(std::string_view bytes) {
  long long values[2] = {0, 0};
  std::size_t at = 2;
  for (long long& value : values) {
    while (at < bytes.size() && !std::isdigit(static_cast<unsigned char>(bytes[at]))) {
      if (bytes[at] == '#') at = bytes.find_first_of("\n\r", at);
      if (at == std::string_view::npos) return std::nullopt;
      ++at;
    }
    for (int digits = 0; at < bytes.size() && std::isdigit(static_cast<unsigned char>(bytes[at]));
         ++at, ++digits) {
      if (digits > 9) return std::nullopt;
      value = 10 * value + (bytes[at] - '0');
    }
    if (at < bytes.size() && !std::isspace(static_cast<unsigned char>(bytes[at])))
      return std::nullopt;
  }
  return ImageSize{values[0], values[1]};
}

// Tags 256 and 257 of the first directory; of a tag that comes twice the first counts, as for
// libtiff. Values of 8 bytes stand elsewhere, those of signed or single bytes are no sizes of ours.
std::optional<ImageSize> TiffSize(std::string_view bytes, bool big_endian) {
  const std::size_t directory = Unsigned(bytes, 4, 4, big_endian);
  const std::uint32_t count = Unsigned(bytes, directory, 2, big_endian);
  ImageSize size;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t entry = directory + 2 + 12 * i;
    const std::uint32_t tag = Unsigned(bytes, entry, 2, big_endian);
    const std::uint32_t type = Unsigned(bytes, entry + 2, 2, big_endian);
    if (tag != 256 && tag != 257) continue;
    if (type != kTiffShort && type != kTiffLong) return std::nullopt;
    long long& extent_px = tag == 256 ? size.width_px : size.height_px;
    if (extent_px == 0)
      extent_px = Unsigned(bytes, entry + 8, type == kTiffShort ? 2 : 4, big_endian);
  }
  return size;
}

// Walks the segments to the start of frame.
std::optional<ImageSize> JpegSize(std::string_view bytes) {
  std::size_t at = 2;
  while (at + 9 < bytes.size() && bytes[at] == '\xFF') {
    const auto marker = static_cast<unsigned char>(bytes[at + 1]);
    const bool starts_frame =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (starts_frame)
      return ImageSize{Unsigned(bytes, at + 7, 2, true), Unsigned(bytes, at + 5, 2, true)};
    at += marker == 0xFF ? 1 : 2 + Unsigned(bytes, at + 2, 2, true);
  }
  return std::nullopt;
}

}  // namespace

std::optional<ImageSize> SizeFromHeader(std::string_view bytes) {
  std::optional<ImageSize> size;
  if (bytes.starts_with("\x89PNG\r\n\x1A\n"))
    size = ImageSize{Unsigned(bytes, 16, 4, true), Unsigned(bytes, 20, 4, true)};
  else if (bytes.starts_with("BM"))
    size = BmpSize(bytes);
  else if (bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6')
    size = PnmSize(bytes);
  else if (bytes.starts_with("II*\0"sv))
    size = TiffSize(bytes, false);
  else if (bytes.starts_with("MM\0*"sv))
    size = TiffSize(bytes, true);
  else if (bytes.starts_with("\xFF\xD8"))
    size = JpegSize(bytes);
  if (size && (size->width_px <= 0 || size->height_px <= 0)) return std::nullopt;
  return size;
}

}  // namespace telestrain
