#include "app/correlate_scene.h"

#include <cmath>
#include <map>

#include "base/numbers.h"
#include "correlation/expected_noise.h"
#include "correlation/field_file.h"
#include "correlation/pattern_file.h"

namespace telestrain {
namespace {

constexpr double kMicro = 1e6, kMilli = 1e3;

std::string NumberOrNone(double value, int decimals) {
  return std::isfinite(value) ? FormatFixed(value, decimals) : "none";
}

// A quantity of --show: its name in words with the unit, and its value at a point.
struct Quantity {
  std::string words, unit;
  double (*value)(const FieldPoint&);
};

const Quantity& QuantityNamed(const std::string& show) {
  static const std::map<std::string, Quantity> quantities = {
      {"magnitude",
       {"displacement magnitude", "px",
        [](const FieldPoint& p) { return p.match.shape.displacement_px.norm(); }}},
      {"u",
       {"displacement u, to the right", "px",
        [](const FieldPoint& p) { return p.match.shape.displacement_px.x(); }}},
      {"v",
       {"displacement v, downwards", "px",
        [](const FieldPoint& p) { return p.match.shape.displacement_px.y(); }}},
      {"exx",
       {"strain \u03b5xx", "\u00b5\u03b5",
        [](const FieldPoint& p) { return kMicro * p.strain(0, 0); }}},
      {"eyy",
       {"strain \u03b5yy", "\u00b5\u03b5",
        [](const FieldPoint& p) { return kMicro * p.strain(1, 1); }}},
      {"exy", {"strain \u03b5xy", "\u00b5\u03b5", [](const FieldPoint& p) {
                 return kMicro * p.strain(0, 1);
               }}}};
  return quantities.at(show);
}

std::function<bool(int, int)> InsideOf(const FieldOptions& options) {
  if (options.mask) return [&mask = *options.mask](int x, int y) { return mask.At(x, y); };
  if (!options.region) return {};
  return [region = *options.region](int x, int y) {
    return x >= region.x && y >= region.y && x < region.x + region.width &&
           y < region.y + region.height;
  };
}

// An empty grid whose first point is at `first_px`: points outside a mask stay empty.
viz::FieldScene EmptyScene(const FieldOptions& options, int columns, int rows,
                           const Eigen::Vector2i& first_px) {
  viz::FieldScene scene;
  scene.columns = columns;
  scene.rows = rows;
  scene.step_px = options.step_px;
  scene.subset_px = options.correlation.subset_px;
  scene.inside = InsideOf(options);
  scene.samples.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      scene
          .samples[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column)]
          .at_px = (first_px + options.step_px * Eigen::Vector2i(column, row)).cast<double>();
  return scene;
}

viz::FieldSample& SampleAt(viz::FieldScene& scene, int column, int row) {
  return scene.samples[static_cast<std::size_t>(row) * static_cast<std::size_t>(scene.columns) +
                       static_cast<std::size_t>(column)];
}

// "2 low contrast, 5 not converged".
std::string FailuresOf(const FieldSummary& summary) {
  std::string text;
  for (std::size_t status = 1; status < summary.count_of_status.size(); ++status)
    if (const std::size_t count = summary.count_of_status[status]; count > 0)
      text += (text.empty() ? "" : ", ") + std::to_string(count) + " " +
              ToText(static_cast<MatchStatus>(status));
  return text;
}

std::string OptionsLine(const FieldOptions& options) {
  const CorrelationOptions& subset = options.correlation;
  constexpr const char* kShapes[] = {"shift", "affine", "quadratic"};
  return std::string(kShapes[subset.shape_order]) + " shape function, " +
         (subset.interpolation == Interpolation::kCubic ? "cubic" : "quintic") +
         " B-spline, blur " + FormatShortest(subset.prefilter_sigma_px) + " px";
}

}  // namespace

std::string SummaryLine(const FieldSummary& summary) {
  const Eigen::Vector2d& mean_px = summary.mean_displacement_px;
  return std::to_string(summary.converged()) + " of " + CountText(summary.points, "point") +
         " ok, mean u " + NumberOrNone(mean_px.x(), 4) + " px, v " + NumberOrNone(mean_px.y(), 4) +
         " px, exx " + NumberOrNone(kMicro * summary.mean_strain(0, 0), 1) +
         " microstrain, noise (1 sigma) " + NumberOrNone(summary.median_sigma_px.x(), 5) + " px, " +
         NumberOrNone(kMicro * summary.median_sigma_strain.x(), 1) + " microstrain";
}

viz::FieldScene SceneOfField(const CorrelationField& field, const FieldSummary& summary,
                             const FieldOptions& options, const std::string& show) {
  const Quantity& quantity = QuantityNamed(show);
  const FieldPoint& any = field.points.front();
  viz::FieldScene scene =
      EmptyScene(options, field.columns, field.rows,
                 any.center_px - options.step_px * Eigen::Vector2i(any.column, any.row));
  scene.value_name = quantity.words + " / " + quantity.unit;
  scene.arrows = true;
  scene.failure = FailuresOf(summary);
  for (const FieldPoint& point : field.points) {
    viz::FieldSample& sample = SampleAt(scene, point.column, point.row);
    sample.failed = !point.match.ok();
    sample.is_point = true;
    if (sample.failed) continue;
    sample.arrow_px = point.match.shape.displacement_px;
    sample.value = quantity.value(point);
  }
  scene.facts = {SummaryLine(summary), OptionsLine(options)};
  scene.notes = {
      "displacement from the reference to the image, shown on the reference; x to the "
      "right, y down"};
  if (show.front() == 'e')
    scene.notes.push_back("Green-Lagrange strain, strain gauge " +
                          std::to_string(StrainGauge_px(options)) + " px wide");
  return scene;
}

viz::FieldScene SceneOfPattern(const CorrelateSetup& setup, const GrayImage& reference) {
  const FieldOptions& options = setup.options;
  Eigen::Vector2i first = setup.centers_px.front(), last = first;
  for (const Eigen::Vector2i& center : setup.centers_px) {
    first = first.cwiseMin(center);
    last = last.cwiseMax(center);
  }
  const Eigen::Vector2i size = (last - first) / options.step_px + Eigen::Vector2i::Ones();
  viz::FieldScene scene = EmptyScene(options, size.x(), size.y(), first);
  const auto sigma_px = ExpectedSigma_px(reference, setup.centers_px, options.correlation.subset_px,
                                         *setup.pattern, options.mask ? &*options.mask : nullptr);
  for (std::size_t i = 0; i < sigma_px.size(); ++i) {
    const Eigen::Vector2i at = (setup.centers_px[i] - first) / options.step_px;
    viz::FieldSample& sample = SampleAt(scene, at.x(), at.y());
    sample.is_point = true;
    sample.value = kMilli * sigma_px[i];
    sample.failed = !std::isfinite(sigma_px[i]);
  }
  scene.value_name = "expected noise of u, v (1 \u03c3) / mpx";
  scene.grid_dots = true;
  scene.failure = "noise hides the texture";
  scene.facts = PatternLines(*setup.pattern, options.correlation.subset_px, options.step_px);
  return scene;
}

}  // namespace telestrain
