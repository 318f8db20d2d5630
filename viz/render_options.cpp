#include <unistd.h>

#include <cmath>
#include <string>

#include "base/numbers.h"
#include "viz/picture_set.h"
#include "viz/render.h"

namespace telestrain {
namespace {

constexpr double kInch_mm = 25.4;
constexpr double kDefaultWidth_mm = 170;  // the report's text width
// Below, letters of 7 pt are less than 7 px high; above, the widest picture is narrower than the
// report's text.
constexpr int kLeastDpi = 72;
constexpr int kMostDpi = static_cast<int>(kMostSide_px * kInch_mm / kDefaultWidth_mm + 0.5);
// Far beyond the values of any quantity; the colour bar's differences and ticks stay finite.
constexpr double kMostRangeEnd = 1e12;
// A4 at 300 dpi takes 95 B per pixel for framebuffers, peeled layers and smoothing.
constexpr double kBytesPerPixel = 95;

Error OutOfRange(const std::string& what, const std::string& wanted, const std::string& found) {
  return {ErrorKind::kUsage, "pictures: " + what + " " + wanted + " is wanted, found " + found};
}

std::string Millimetres(double width, double height) {
  return FormatFixed(width, 0) + " x " + FormatFixed(height, 0) + " mm";
}

Status CheckSize(const RenderOptions& options) {
  for (const auto& [name, side] :
       {std::pair{"width_px", options.width_px}, std::pair{"height_px", options.height_px}})
    if (side < 1 || side > kMostSide_px)
      return OutOfRange(name, "from 1 to " + std::to_string(kMostSide_px), std::to_string(side));
  const int dpi = options.Dpi();
  if (dpi < kLeastDpi || dpi > kMostDpi)
    return OutOfRange(
        "dots_per_inch", "from " + std::to_string(kLeastDpi) + " to " + std::to_string(kMostDpi),
        std::to_string(dpi) +
            (options.dots_per_inch == 0
                 ? ", which makes width_px " + std::to_string(options.width_px) + " 170 mm wide"
                 : ""));
  const double width_mm = options.width_px * kInch_mm / dpi;
  const double height_mm = options.height_px * kInch_mm / dpi;
  // Half a pixel of the default resolution is rounded away.
  if (width_mm < viz::kLeastPaperWidth_mm - 0.1 || height_mm < viz::kLeastPaperHeight_mm - 0.1)
    return OutOfRange("width_px x height_px",
                      "of at least " +
                          Millimetres(viz::kLeastPaperWidth_mm, viz::kLeastPaperHeight_mm) +
                          " on paper, for the texts to fit,",
                      Millimetres(width_mm, height_mm) + " at " + std::to_string(dpi) + " dpi");
  return {};
}

Status CheckMemory(const RenderOptions& options) {
  const double wanted = kBytesPerPixel * options.width_px * options.height_px;
  const double present =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  constexpr double kGib = 1024.0 * 1024 * 1024;
  if (wanted <= present) return {};
  return OutOfRange(
      "width_px x height_px",
      "that needs no more than the machine's memory of " + FormatFixed(present / kGib, 1) + " GiB",
      std::to_string(options.width_px) + " x " + std::to_string(options.height_px) +
          ", which needs " + FormatFixed(wanted / kGib, 1) + " GiB");
}

}  // namespace

int RenderOptions::Dpi() const {
  return dots_per_inch != 0 ? dots_per_inch
                            : static_cast<int>(std::lround(width_px * kInch_mm / kDefaultWidth_mm));
}

Status CheckRenderOptions(const RenderOptions& options) {
  TELESTRAIN_RETURN_IF_ERROR(CheckSize(options));
  TELESTRAIN_RETURN_IF_ERROR(CheckMemory(options));
  if (!options.range) return {};
  const auto [low, high] = *options.range;
  if (!std::isfinite(low) || !std::isfinite(high) || !(low < high))
    return OutOfRange("range", "with a low end below the high one",
                      FormatShortest(low) + " to " + FormatShortest(high));
  if (low < -kMostRangeEnd || high > kMostRangeEnd)
    return OutOfRange("range", "with ends from -1e12 to 1e12",
                      FormatShortest(low) + " to " + FormatShortest(high));
  return {};
}

}  // namespace telestrain
