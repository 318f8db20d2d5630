#include "diagnostics/residual_statistics.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/check.h"

namespace telestrain {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::size_t kTooFewScalars = 5;  // mrcal's
constexpr double kTriggerSigmas = 5, kMarkSigmas = 4;

// Count, mean and standard deviation (divided by the count).
struct Moments {
  std::size_t count = 0;
  double mean = 0, sd = 0;
};
Moments MomentsOf(const std::vector<double>& values) {
  Moments moments;
  moments.count = values.size();
  if (values.empty()) return moments;
  const auto n = static_cast<double>(values.size());
  for (const double value : values) moments.mean += value / n;
  double squares = 0;
  for (const double value : values) squares += (value - moments.mean) * (value - moments.mean);
  moments.sd = std::sqrt(squares / n);
  return moments;
}

std::vector<double> InlierScalars(const ResidualList& residuals) {
  std::vector<double> scalars;
  for (const CornerResidual& r : residuals)
    if (!r.is_outlier) scalars.insert(scalars.end(), {r.residual_px.x(), r.residual_px.y()});
  return scalars;
}

double LargestScalar(const CornerResidual& r) { return r.residual_px.cwiseAbs().maxCoeff(); }

// Points from `first` to `last`; one alone in the middle.
double GridStep(int extent_px, int points) {
  return points > 1 ? static_cast<double>(extent_px - 1) / (points - 1) : extent_px;
}

}  // namespace

ResidualList ResidualsOf(const CalibrationData& data, const ArrayState& state) {
  ResidualList residuals;
  residuals.reserve(static_cast<std::size_t>(data.CornerCount()));
  for (const BoardData& board : data.boards) {
    const Eigen::Matrix2Xd errors_px = ReprojectionErrors_px(state, board);
    for (Eigen::Index i = 0; i < errors_px.cols(); ++i) {
      const auto index = static_cast<std::size_t>(i);
      CornerResidual residual{board.image, board.view, board.geometry.board, board.corner[index]};
      residual.observed_px = board.pixels.col(i);
      residual.residual_px = errors_px.col(i);
      residual.whitened = board.whitening[index] * residual.residual_px;
      residuals.push_back(residual);
    }
  }
  return residuals;
}

ResidualList OfView(const ResidualList& residuals, int view) {
  ResidualList found;
  std::copy_if(residuals.begin(), residuals.end(), std::back_inserter(found),
               [&](const CornerResidual& r) { return r.view == view; });
  return found;
}

ResidualSummary Summarise(const ResidualList& residuals) {
  ResidualSummary summary;
  double squares_px2 = 0, whitened = 0;
  for (const CornerResidual& r : residuals) {
    ++summary.corners;
    summary.outliers += r.is_outlier;
    if (r.is_outlier) continue;
    squares_px2 += r.residual_px.squaredNorm();
    whitened += r.whitened.squaredNorm();
    summary.worst_corner_px = std::max(summary.worst_corner_px, r.residual_px.norm());
  }
  const int inliers = summary.corners - summary.outliers;
  if (inliers == 0) return summary;
  summary.rms_per_scalar_px = std::sqrt(squares_px2 / (2.0 * summary.corners));
  summary.rms_of_inliers_per_scalar_px = std::sqrt(squares_px2 / (2.0 * inliers));
  summary.rms_of_inliers_per_corner_px = std::sqrt(squares_px2 / inliers);
  summary.rms_whitened = std::sqrt(whitened / (2.0 * inliers));
  const Moments moments = MomentsOf(InlierScalars(residuals));
  summary.mean_px = moments.mean;
  summary.sigma_px = moments.sd;
  return summary;
}

double ExpectedRms_px(double sigma_px, int states, int measurements) {
  TELESTRAIN_CHECK(measurements > states && states >= 0, "fewer measurements than states");
  return sigma_px * std::sqrt(1 - static_cast<double>(states) / measurements);
}

double ResidualHistogram::Gaussian(double x_px) const {
  if (!(sigma_px > 0)) return 0;
  const double z = (x_px - mean_px) / sigma_px;
  return gaussian_scale_px * std::exp(-z * z / 2) / (std::sqrt(2 * kPi) * sigma_px);
}

ResidualHistogram HistogramOfResiduals(const ResidualList& residuals, double bin_px) {
  TELESTRAIN_CHECK(bin_px > 0, "the bins need a width");
  ResidualHistogram histogram;
  histogram.bin_px = bin_px;
  const std::vector<double> scalars = InlierScalars(residuals);
  const Moments moments = MomentsOf(scalars);
  histogram.scalars = static_cast<int>(moments.count);
  histogram.mean_px = moments.mean;
  histogram.sigma_px = moments.sd;
  if (scalars.empty()) return histogram;
  if (moments.sd > 0)
    histogram.gaussian_scale_px = histogram.scalars * std::sqrt(2 * kPi) * moments.sd *
                                  std::erf(bin_px / (2 * std::sqrt(2.0) * moments.sd));
  const auto bin_of = [&](double x) { return static_cast<int>(std::floor(x / bin_px + 0.5)); };
  const auto [low, high] = std::minmax_element(scalars.begin(), scalars.end());
  histogram.first_bin = bin_of(*low);
  histogram.counts.assign(static_cast<std::size_t>(bin_of(*high) - histogram.first_bin + 1), 0);
  for (const double x : scalars)
    ++histogram.counts[static_cast<std::size_t>(bin_of(x) - histogram.first_bin)];
  return histogram;
}

double BinFor_px(double sigma_px) {
  if (!(sigma_px > 0)) return 0;
  const double wanted = sigma_px / 4, decade = std::pow(10, std::floor(std::log10(wanted)));
  const double leading = wanted / decade;
  return decade * (leading < 1.5 ? 1 : leading < 3.5 ? 2 : leading < 7.5 ? 5 : 10);
}

std::vector<BoardFigures> BoardsFromWorst(const ResidualList& residuals) {
  std::map<std::pair<int, int>, BoardFigures> found;
  for (const CornerResidual& r : residuals) {
    BoardFigures& board = found[{r.image, r.view}];
    board.image = r.image;
    board.view = r.view;
    board.board = r.board;
    board.outliers += r.is_outlier;
    if (r.is_outlier) continue;
    ++board.inliers;
    board.square_sum_px2 += r.residual_px.squaredNorm();
    if (board.worst_corner >= 0 && Magnitude_px(r) <= board.worst_corner_px) continue;
    board.worst_corner = r.corner;
    board.worst_corner_px = Magnitude_px(r);
  }
  std::vector<BoardFigures> boards;
  for (auto& [key, board] : found) {
    if (board.inliers > 0)
      board.rms_per_corner_px = std::sqrt(board.square_sum_px2 / board.inliers);
    boards.push_back(board);
  }
  std::stable_sort(boards.begin(), boards.end(), [](const BoardFigures& a, const BoardFigures& b) {
    return a.rms_per_corner_px > b.rms_per_corner_px;
  });
  return boards;
}

double Magnitude_px(const CornerResidual& residual) { return residual.residual_px.norm(); }

double Direction_rad(const CornerResidual& residual) {
  return std::atan2(residual.residual_px.y(), residual.residual_px.x());
}

DirectionHistogram DirectionsOf(const ResidualList& residuals, int sectors) {
  TELESTRAIN_CHECK(sectors > 0, "the directions need a sector");
  DirectionHistogram directions;
  directions.counts.assign(static_cast<std::size_t>(sectors), 0);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int count = 0;
  for (const CornerResidual& r : residuals) {
    if (r.is_outlier || Magnitude_px(r) == 0) continue;
    const int sector = static_cast<int>((Direction_rad(r) + kPi) / (2 * kPi) * sectors);
    ++directions.counts[static_cast<std::size_t>(std::min(sector, sectors - 1))];
    sum += r.residual_px.normalized();
    ++count;
  }
  if (count == 0) return directions;
  directions.mean_direction_rad = std::atan2(sum.y(), sum.x());
  directions.mean_resultant = sum.norm() / count;
  return directions;
}

RegionalMap RegionalStatistics(const ResidualList& residuals, const PixelRegion& region,
                               int columns, int rows) {
  RegionalMap map;
  map.columns = columns;
  map.rows = rows > 0 ? rows
                      : static_cast<int>(std::nearbyint(static_cast<double>(region.height) /
                                                        region.width * columns));
  map.first_x_px = region.x;
  map.first_y_px = region.y;
  map.step_x_px = GridStep(region.width, columns);
  map.step_y_px = GridStep(region.height, map.rows);
  const Eigen::Array2d half_step(map.step_x_px / 2, map.step_y_px / 2);
  for (int y = 0; y < map.rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const Eigen::Array2d center(region.x + x * map.step_x_px, region.y + y * map.step_y_px);
      std::vector<double> scalars;
      for (const CornerResidual& r : residuals)
        if (!r.is_outlier && ((r.observed_px.array() - center).abs() < half_step).all())
          scalars.insert(scalars.end(), {r.residual_px.x(), r.residual_px.y()});
      const bool enough = scalars.size() > kTooFewScalars;
      const Moments moments = enough ? MomentsOf(scalars) : Moments();
      map.mean_px.push_back(moments.mean);
      map.sd_px.push_back(moments.sd);
      map.scalars.push_back(static_cast<int>(scalars.size()));
    }
  return map;
}

OutlierPass MarkOutliers(const ResidualList& residuals) {
  OutlierPass pass;
  double squares_px2 = 0, largest_px = 0;
  int inliers = 0;
  for (const CornerResidual& r : residuals) {
    if (r.is_outlier) continue;
    squares_px2 += r.residual_px.squaredNorm();
    largest_px = std::max(largest_px, LargestScalar(r));
    ++inliers;
  }
  if (inliers == 0) return pass;
  pass.sigma_px = std::sqrt(squares_px2 / (2.0 * inliers));
  if (largest_px <= kTriggerSigmas * pass.sigma_px) return pass;
  for (std::size_t i = 0; i < residuals.size(); ++i)
    if (!residuals[i].is_outlier && LargestScalar(residuals[i]) > kMarkSigmas * pass.sigma_px)
      pass.marked.push_back(i);
  return pass;
}

std::vector<OutlierPass> ReplayOutlierRule(ResidualList& residuals) {
  std::vector<OutlierPass> passes;
  do {
    passes.push_back(MarkOutliers(residuals));
    for (const std::size_t i : passes.back().marked) residuals[i].is_outlier = true;
  } while (!passes.back().marked.empty());
  return passes;
}

}  // namespace telestrain
