#include "correlation/correlation_field.h"

#include <algorithm>

#include "base/check.h"
#include "correlation/field_matching.h"
#include "correlation/strain_field.h"

namespace telestrain {

using namespace correlation;

namespace {

// Kept from the image's border: 3 px that the interpolation needs, and as much again and more as
// the mirrored border reaches into the blurred image and its spline.
constexpr int kBorder_px = 8;

std::vector<Eigen::Vector2i> GridInside(const PixelRegion& image, const FieldOptions& options) {
  const int reach = options.correlation.subset_px / 2 + kBorder_px;
  const PixelRegion where = options.region.value_or(image);
  const Eigen::Vector2i low(std::max(where.x, image.x + reach), std::max(where.y, image.y + reach));
  const Eigen::Vector2i high(std::min(where.x + where.width, image.x + image.width - reach),
                             std::min(where.y + where.height, image.y + image.height - reach));
  const int step = GridStep_px(options);
  std::vector<Eigen::Vector2i> centers;
  for (int y = low.y(); y < high.y(); y += step)
    for (int x = low.x(); x < high.x(); x += step) centers.push_back({x, y});
  return centers;
}

}  // namespace

std::vector<Eigen::Vector2i> GridCenters(int width_px, int height_px, const FieldOptions& options) {
  return GridInside({0, 0, width_px, height_px}, options);
}

CorrelationField Correlate(const CorrelationReference& reference, const GrayImage& image,
                           const FieldOptions& options) {
  TELESTRAIN_CHECK(reference.options().subset_px == options.correlation.subset_px,
                   "the reference must be made with the options of the field");
  const auto centers = GridInside(reference.region(), options);
  const auto masked = MaskedPoints(centers, options);
  const ReferenceBands bands(reference);
  const GrayImage gray = reference.BlurredImage();
  const FieldMatching matching{bands,
                               {gray, {reference.region().x, reference.region().y}},
                               centers,
                               masked,
                               GridColumns(centers),
                               options};
  CorrelationField field = MakeField(centers, matching.Match(image, {}), options);
  ComputeStrain(options, field);
  return field;
}

}  // namespace telestrain
