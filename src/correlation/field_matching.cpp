#include "correlation/field_matching.h"

#include <algorithm>
#include <utility>

namespace telestrain::correlation {
namespace {

constexpr double kSmallStrain = 0.05;  // the blur of 0.7 px changes by 0.035 px

bool MostConverged(const std::vector<SubsetMatch>& matches) {
  std::size_t measurable = 0, converged = 0;
  for (const SubsetMatch& match : matches) {
    measurable += IsMeasurable(match.status);
    converged += match.ok();
  }
  return 2 * converged >= measurable;
}

// The mean gradient when it strains the pattern so much that both images would lose different
// detail to the same blur; otherwise zero, which is faster.
Eigen::Matrix2d StretchOfBlur(const std::vector<std::optional<ShapeFunction>>& starts) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  double count = 0;
  for (const auto& start : starts) {
    if (!start) continue;
    sum += start->gradient;
    ++count;
  }
  if (!(count > 0)) return Eigen::Matrix2d::Zero();
  const Eigen::Matrix2d mean = sum / count;
  const Eigen::Matrix2d strain = 0.5 * (mean + mean.transpose() + mean.transpose() * mean);
  if (strain.cwiseAbs().maxCoeff() < kSmallStrain) return Eigen::Matrix2d::Zero();
  return mean;
}

}  // namespace

std::vector<SubsetMatch> FieldMatching::Match(
    const GrayImage& image, const std::vector<std::optional<ShapeFunction>>& starts) const {
  const PreparedImage prepared(image, {0, 0, image.width, image.height}, options.correlation,
                               StretchOfBlur(starts));
  PointPropagation points(bands, centers_px, prepared);
  std::vector<Eigen::Vector2i> allowed;
  for (std::size_t i = 0; i < centers_px.size(); ++i) {
    if (masked[i])
      points.Exclude(static_cast<int>(i), MatchStatus::kMasked);
    else
      allowed.push_back(centers_px[i]);
  }
  if (!starts.empty()) points.MatchFrom(starts);
  if (starts.empty() || !MostConverged(points.matches())) {
    points.AddSeeds(SearchSeeds(seeds, image, allowed, options));
    points.Spread();
  }
  points.RetryFailures();
  points.MatchUntried();
  if (columns > 0) points.RecheckOutliers(columns);
  return points.TakeMatches();
}

int GridStep_px(const FieldOptions& options) {
  return options.step_px > 0 ? options.step_px : std::max(1, options.correlation.subset_px / 4);
}

std::vector<char> MaskedPoints(const std::vector<Eigen::Vector2i>& centers_px,
                               const FieldOptions& options) {
  std::vector<char> masked(centers_px.size(), 0);
  if (!options.mask) return masked;
  for (std::size_t i = 0; i < masked.size(); ++i)
    masked[i] = !options.mask->At(centers_px[i].x(), centers_px[i].y());
  return masked;
}

int GridColumns(const std::vector<Eigen::Vector2i>& centers_px) {
  const auto below = std::find_if(centers_px.begin(), centers_px.end(), [&](const auto& center) {
    return center.y() != centers_px.front().y();
  });
  return static_cast<int>(below - centers_px.begin());
}

CorrelationField MakeField(const std::vector<Eigen::Vector2i>& centers_px,
                           std::vector<SubsetMatch> matches, const FieldOptions& options) {
  CorrelationField field;
  field.step_px = GridStep_px(options);
  field.subset_px = options.correlation.subset_px;
  field.columns = GridColumns(centers_px);
  field.rows = field.columns > 0 ? static_cast<int>(centers_px.size()) / field.columns : 0;
  field.points.resize(centers_px.size());
  for (std::size_t i = 0; i < centers_px.size(); ++i) {
    FieldPoint& point = field.points[i];
    point.column = static_cast<int>(i) % field.columns;
    point.row = static_cast<int>(i) / field.columns;
    point.center_px = centers_px[i];
    point.match = std::move(matches[i]);
  }
  return field;
}

bool IsMeasurable(MatchStatus status) {
  return status == MatchStatus::kConverged || status == MatchStatus::kNotConverged ||
         status == MatchStatus::kLowCorrelation;
}

}  // namespace telestrain::correlation
