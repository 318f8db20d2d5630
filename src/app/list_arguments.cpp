#include "app/list_arguments.h"

#include <algorithm>
#include <limits>
#include <string_view>

#include "base/numbers.h"

namespace telestrain {
namespace {

Error WrongUsage(std::string message) { return {ErrorKind::kUsage, std::move(message)}; }

// As long long: the sum of two numbers of the command line may leave the range of int.
long long EndOf(int begin, int length) { return static_cast<long long>(begin) + length; }

}  // namespace

std::optional<std::vector<int>> WholeNumbersIn(const std::string& text) {
  std::vector<int> numbers;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t comma = std::min(text.find(',', start), text.size());
    const auto number = ParseInt(std::string_view(text).substr(start, comma - start));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    start = comma + 1;
  }
  return numbers;
}

Result<PixelRegion> RegionInside(const std::string& text, const std::vector<int>& numbers,
                                 int width_px, int height_px) {
  const std::string wanted = "--region " + text + ": ";
  if (numbers.size() != 4)
    return WrongUsage(wanted + std::to_string(numbers.size()) +
                      " numbers; wanted are four: x,y,width,height in px");
  const PixelRegion region{numbers[0], numbers[1], numbers[2], numbers[3]};
  if (region.width < 1 || region.height < 1)
    return WrongUsage(wanted + "the region is empty; width and height are at least 1 px");
  const long long right = EndOf(region.x, region.width), bottom = EndOf(region.y, region.height);
  if (region.x < 0 || region.y < 0 || right > width_px || bottom > height_px)
    return WrongUsage(wanted + "reaches from (" + std::to_string(region.x) + ", " +
                      std::to_string(region.y) + ") to (" + std::to_string(right - 1) + ", " +
                      std::to_string(bottom - 1) + ") px, the image has " +
                      std::to_string(width_px) + " x " + std::to_string(height_px) +
                      " px; give a region inside it");
  return region;
}

Result<PixelRegion> CulledRegion(const std::string& text) {
  constexpr long long kLargest = std::numeric_limits<int>::max();
  const auto numbers = WholeNumbersIn(text).value_or(std::vector<int>{});
  const bool is_region = numbers.size() == 4 && numbers[2] > 0 && numbers[3] > 0 &&
                         EndOf(numbers[0], numbers[2]) <= kLargest &&
                         EndOf(numbers[1], numbers[3]) <= kLargest;
  if (!is_region)
    return WrongUsage("--cull '" + text +
                      "' is no region; give four whole numbers X,Y,WIDTH,HEIGHT in pixels of the "
                      "sensor, such as 0,0,200,972");
  return PixelRegion{numbers[0], numbers[1], numbers[2], numbers[3]};
}

Result<std::pair<std::string, std::string>> DocumentEntry(const std::string& text) {
  const std::size_t end = text.find('=');
  const std::string key = text.substr(0, end);
  if (end == std::string::npos || key.empty() ||
      key.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") != std::string::npos)
    return WrongUsage("--document '" + text +
                      "': KEY=TEXT is wanted, with a key of small letters, digits and underscores");
  std::string value = text.substr(end + 1);
  if (!IsDocumentEntry(key, value))
    return WrongUsage("--document '" + text +
                      "': a date after ISO 8601 is wanted, such as 2026-01-17");
  return std::pair(key, std::move(value));
}

}  // namespace telestrain
