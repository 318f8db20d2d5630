#include "app/correlate_setup.h"

#include <algorithm>

#include "app/correlate_region.h"
#include "base/files.h"
#include "base/utf8.h"
#include "target/image_file.h"
#include "target/image_header.h"

namespace telestrain {
namespace {

// Half a kilobyte a point: 2 GB.
constexpr std::size_t kMostPoints = 4'000'000;
// AssessPattern wants 64 px; with less than twice that the speckles would be too few to count.
constexpr int kLeastAssessed_px = 128;

// The pixels that the subsets may see: the region and half a subset around it, grown to what an
// assessment needs and cut to the image.
PixelRegion SeenRegion(const PixelRegion& region, int subset_px, const GrayImage& image) {
  const auto grown = [&](int start, int size, int whole) {
    const int margin = std::max(subset_px / 2, (kLeastAssessed_px - size + 1) / 2);
    const int first = std::max(start - margin, 0), end = std::min(start + size + margin, whole);
    return std::pair{first, end - first};
  };
  const auto [x, width] = grown(region.x, region.width, image.width);
  const auto [y, height] = grown(region.y, region.height, image.height);
  return {x, y, width, height};
}

Result<PatternAssessment> Assess(const GrayImage& reference, FieldOptions options) {
  if (options.region && !options.mask)
    options.region = SeenRegion(*options.region, options.correlation.subset_px, reference);
  return AssessPattern(reference, options);
}

FieldOptions OptionsOf(const CorrelateArguments& arguments) {
  FieldOptions options;
  options.correlation.shape_order = arguments.order;
  options.correlation.interpolation =
      arguments.cubic ? Interpolation::kCubic : Interpolation::kQuintic;
  options.correlation.threads = arguments.threads;
  options.strain_window_points = arguments.strain_window_points;
  if (arguments.incremental == "off") options.update_below_zncc = 0;
  if (arguments.subset_px) options.correlation.subset_px = *arguments.subset_px;
  return options;
}

// The largest subset of which at least one fits, 0: none.
int LargestSubset_px(const GrayImage& reference, FieldOptions options) {
  options.step_px = std::max({reference.width, reference.height, 1});  // one point is enough
  int& subset_px = options.correlation.subset_px;
  for (subset_px = kMostSubset_px; subset_px >= kLeastSubset_px; subset_px -= 2)
    if (!GridCenters(reference.width, reference.height, options).empty()) return subset_px;
  return 0;
}

Status CheckGrid(const CorrelateSetup& setup, const GrayImage& reference) {
  if (setup.centers_px.empty()) {
    const int largest_px = LargestSubset_px(reference, setup.options);
    return WrongUsage("--subset-px " + std::to_string(setup.options.correlation.subset_px) +
                      ": not one whole subset with its border fits around a point of the region "
                      "into the image of " +
                      std::to_string(reference.width) + " x " + std::to_string(reference.height) +
                      " px; " +
                      (largest_px > 0 ? "the largest that fits has " + std::to_string(largest_px) +
                                            " px, a larger region may allow more"
                                      : "give a larger region or image"));
  }
  if (setup.centers_px.size() > kMostPoints)
    return WrongUsage("--step-px " + std::to_string(setup.options.step_px) + " makes " +
                      std::to_string(setup.centers_px.size()) + " points, the limit is " +
                      std::to_string(kMostPoints) + "; take a larger step or a smaller region");
  return {};
}

void ChooseSubset(const CorrelateArguments& arguments, CorrelateSetup* setup) {
  int& subset_px = setup->options.correlation.subset_px;
  if (!arguments.subset_px && setup->pattern) subset_px = setup->pattern->recommended_subset_px;
  setup->options.step_px = arguments.subset_px || !setup->pattern
                               ? std::max(1, subset_px / 4)
                               : setup->pattern->recommended_step_px;
  if (arguments.step_px) setup->options.step_px = *arguments.step_px;
}

// Where the texture ends depends on the subset, and the subset on the pattern inside.
Status SetTextureRegion(const CorrelateArguments& arguments, const GrayImage& reference,
                        CorrelateSetup* setup) {
  int subset_px = setup->options.correlation.subset_px;
  if (!arguments.subset_px) {
    TELESTRAIN_ASSIGN_OR_RETURN(const auto whole, Assess(reference, setup->options));
    subset_px = whole.recommended_subset_px;
  }
  return SetRegion("auto", reference, subset_px, setup);
}

}  // namespace

Result<InputImage> ReadInput(const std::filesystem::path& path) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path, kMostImageBytes));
  TELESTRAIN_ASSIGN_OR_RETURN(GrayImage image, DecodeGrayImage(path.string(), bytes));
  return InputImage{path, Sha256Hex(bytes), std::move(image)};
}

std::string ShownName(const std::filesystem::path& path) {
  std::string name = path.filename().string();
  if (!IsValidUtf8(name))
    for (char& byte : name)
      if (static_cast<unsigned char>(byte) > 0x7f) byte = '?';
  return name;
}

Status CheckImages(const std::vector<std::string>& images, const GrayImage& reference) {
  for (const std::string& path : images) {
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path, kMostImageBytes));
    TELESTRAIN_RETURN_IF_ERROR(CheckImageBytes(path, bytes));
    const auto size = SizeFromHeader(bytes);
    if (size->width_px != reference.width || size->height_px != reference.height)
      return BadInput(path + ": the image has " + std::to_string(size->width_px) + " x " +
                      std::to_string(size->height_px) + " px, the reference " +
                      std::to_string(reference.width) + " x " + std::to_string(reference.height) +
                      " px; give images of one size");
  }
  return {};
}

Result<CorrelateSetup> SetUp(const CorrelateArguments& arguments, const GrayImage& reference) {
  CorrelateSetup setup;
  setup.options = OptionsOf(arguments);
  if (arguments.region == "auto")
    TELESTRAIN_RETURN_IF_ERROR(SetTextureRegion(arguments, reference, &setup));
  else
    TELESTRAIN_RETURN_IF_ERROR(SetRegion(arguments.region, reference, 0, &setup));
  const auto pattern = Assess(reference, setup.options);
  if (pattern) setup.pattern = *pattern;
  if (!pattern && !arguments.subset_px) return pattern.error();
  ChooseSubset(arguments, &setup);
  setup.centers_px = GridCenters(reference.width, reference.height, setup.options);
  const bool is_any = !setup.centers_px.empty();
  if (setup.options.mask)
    std::erase_if(setup.centers_px, [&](const Eigen::Vector2i& center) {
      return !setup.options.mask->At(center.x(), center.y());
    });
  if (is_any && setup.centers_px.empty())
    return WrongUsage("--step-px " + std::to_string(setup.options.step_px) +
                      ": no point of the grid lies inside the mask; take a smaller step");
  TELESTRAIN_RETURN_IF_ERROR(CheckGrid(setup, reference));
  return setup;
}

}  // namespace telestrain
