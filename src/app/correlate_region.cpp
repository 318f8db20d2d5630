#include "app/correlate_region.h"

#include <algorithm>

#include "app/list_arguments.h"
#include "correlation/texture_region.h"

namespace telestrain {
namespace {

std::string SizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " px";
}

// The smallest region that holds all pixels inside; of none an empty one.
PixelRegion Around(const PixelMask& mask) {
  int left = mask.width, top = mask.height, right = -1, bottom = -1;
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) {
      if (!mask.At(x, y)) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = y;
    }
  if (right < 0) return {};
  return {left, top, right - left + 1, bottom - top + 1};
}

Status UseMask(PixelMask mask, const Error& empty, CorrelateSetup* setup) {
  const PixelRegion region = Around(mask);
  if (region.width < 1) return empty;
  setup->options.region = region;
  setup->options.mask = std::move(mask);
  return {};
}

Status ReadMask(const std::string& file, const GrayImage& reference, CorrelateSetup* setup) {
  TELESTRAIN_ASSIGN_OR_RETURN(InputImage input, ReadInput(file));
  const GrayImage& image = input.image;
  if (image.width != reference.width || image.height != reference.height)
    return BadInput(file + ": the mask has " + SizeText(image.width, image.height) +
                    ", the reference " + SizeText(reference.width, reference.height) +
                    "; give a mask of the reference's size");
  PixelMask mask{image.width, image.height, {}};
  mask.inside.reserve(image.pixels.size());
  for (const float gray : image.pixels) mask.inside.push_back(gray > 0 ? 1 : 0);
  const auto empty = BadInput(file +
                              ": every pixel of the mask is 0, so none lies inside; any "
                              "other value marks the region");
  TELESTRAIN_RETURN_IF_ERROR(UseMask(std::move(mask), empty, setup));
  input.image = {};
  setup->mask = std::move(input);
  return {};
}

}  // namespace

Status SetRegion(const std::string& region, const GrayImage& reference, int subset_px,
                 CorrelateSetup* setup) {
  if (region.empty()) return {};
  if (region == "auto") {
    const auto empty = BadInput("--region auto: the reference has no texture that subsets of " +
                                std::to_string(subset_px) +
                                " px could follow; give the region as x,y,w,h or as a mask");
    return UseMask(TextureRegion(reference, subset_px), empty, setup);
  }
  if (const auto numbers = WholeNumbersIn(region)) {
    TELESTRAIN_ASSIGN_OR_RETURN(setup->options.region,
                                RegionInside(region, *numbers, reference.width, reference.height));
    return {};
  }
  if (region.find_first_not_of("0123456789,.- ") == std::string::npos)
    return WrongUsage("--region " + region +
                      ": wanted are four whole numbers without blanks: x,y,width,height in px");
  return ReadMask(region, reference, setup);
}

}  // namespace telestrain
