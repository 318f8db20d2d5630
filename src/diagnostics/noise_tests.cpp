#include "diagnostics/noise_tests.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "base/check.h"
#include "diagnostics/noise_distributions.h"
#include "diagnostics/noise_moran.h"

namespace telestrain {
namespace {

// Cells of the field: enough corners that their sums are noise of equal size, and small enough
// to resolve a third-order pattern.
constexpr double kCornersPerCell = 8;
constexpr double kFewestCells = 16, kMostCells = 140;

// Neighbours lie within two steps: smooth patterns are alike over as much, and the more pairs there
// are the better they show. Each pair once.
constexpr std::array<std::pair<int, int>, 6> kHalfOfNeighbours{
    {{0, 1}, {1, 0}, {1, 1}, {1, -1}, {0, 2}, {2, 0}}};

// Values on a lattice. Layers do not touch.
struct Lattice {
  using Place = std::tuple<int, int, int>;  // layer, row, column
  struct Sum {
    double value = 0;
    int count = 0;
  };
  std::map<Place, Sum> sums;

  void Add(const Place& place, double value) {
    Sum& sum = sums[place];
    sum.value += value;
    ++sum.count;
  }
  // Of the sums over the square roots of their counts: noise of equal size.
  SpatialTest Test() const;
};

SpatialTest Lattice::Test() const {
  std::map<Place, int> index;
  std::vector<double> values;
  for (const auto& [place, sum] : sums) {
    index[place] = static_cast<int>(values.size());
    values.push_back(sum.value / std::sqrt(sum.count));
  }
  std::vector<std::pair<int, int>> neighbours;
  for (const auto& [place, i] : index) {
    for (const auto& [down, right] : kHalfOfNeighbours) {
      const auto [layer, row, column] = place;
      const auto found = index.find({layer, row + down, column + right});
      if (found != index.end()) neighbours.emplace_back(i, found->second);
    }
  }
  const MoranStatistic moran = MoransI(values, neighbours);
  SpatialTest test;
  test.places = static_cast<int>(values.size());
  test.morans_i = moran.i;
  test.expected_i = moran.expected;
  test.z = moran.z;
  test.p_value = moran.p_value;
  return test;
}

// Cells over the bounding box of the corners that one view saw.
struct FieldCells {
  explicit FieldCells(const ResidualList& residuals);
  Lattice::Place PlaceOf(const CornerResidual& r) const;

  Eigen::Array2d low_px, cell_px;
};

FieldCells::FieldCells(const ResidualList& residuals) : low_px(0, 0), cell_px(1, 1) {
  if (residuals.empty()) return;
  Eigen::Array2d high_px = low_px = residuals.front().observed_px.array();
  for (const CornerResidual& r : residuals) {
    low_px = low_px.min(r.observed_px.array());
    high_px = high_px.max(r.observed_px.array());
  }
  const Eigen::Array2d size_px = (high_px - low_px).max(1.0);
  const double cells =
      std::clamp(static_cast<double>(residuals.size()) / kCornersPerCell, kFewestCells, kMostCells);
  const double side_px = std::sqrt(size_px.prod() / cells);
  cell_px = size_px / (size_px / side_px).ceil() * (1 + 1e-9);
}

Lattice::Place FieldCells::PlaceOf(const CornerResidual& r) const {
  const Eigen::Array2d cell = ((r.observed_px.array() - low_px) / cell_px).floor();
  return {0, static_cast<int>(cell.y()), static_cast<int>(cell.x())};
}

std::vector<SpatialTest> SpatialTestsOfView(const ResidualList& residuals, int view,
                                            int grid_columns) {
  const FieldCells cells(residuals);
  std::vector<SpatialTest> tests;
  for (int component = 0; component < 2; ++component) {
    std::array<Lattice, 3> lattices;
    for (const CornerResidual& r : residuals) {
      const double value = r.whitened[component];
      const int row = r.corner / grid_columns, column = r.corner % grid_columns;
      lattices[SpatialTest::kNeighbours].Add({r.image, row, column}, value);
      lattices[SpatialTest::kField].Add(cells.PlaceOf(r), value);
      lattices[SpatialTest::kBoard].Add({r.board, row, column}, value);
    }
    for (std::size_t kind = 0; kind < lattices.size(); ++kind) {
      SpatialTest test = lattices[kind].Test();
      test.over = static_cast<SpatialTest::Over>(kind);
      test.view = view;
      test.component = component;
      tests.push_back(test);
    }
  }
  return tests;
}

// Straight line through the means of the images, each weighing as much as it has corners.
TrendTest TrendOf(const ResidualList& residuals, int view, int component) {
  std::map<int, Lattice::Sum> images;
  for (const CornerResidual& r : residuals) {
    images[r.image].value += r.residual_px[component];
    ++images[r.image].count;
  }
  TrendTest trend{view, component, static_cast<int>(images.size())};
  if (trend.images < 3) return trend;
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (const auto& [image, sum] : images) {
    n += sum.count;
    x += sum.count * static_cast<double>(image);
    y += sum.value;
  }
  for (const auto& [image, sum] : images) {
    const double dx = image - x / n, dy = sum.value / sum.count - y / n;
    xx += sum.count * dx * dx;
    xy += sum.count * dx * dy;
    yy += sum.count * dy * dy;
  }
  const double slope = xy / xx, degrees = trend.images - 2;
  const double length = images.rbegin()->first - images.begin()->first;
  const double variance = std::max(yy - slope * xy, 0.0) / degrees;
  trend.change_px = slope * length;
  trend.sigma_change_px = std::sqrt(variance / xx) * length;
  if (trend.sigma_change_px > 0)
    trend.p_value = StudentTwoSided(trend.change_px / trend.sigma_change_px, degrees);
  return trend;
}

template <typename Test>
void Adjust(std::vector<Test>& tests) {
  std::vector<double> p_values;
  for (const Test& test : tests) p_values.push_back(test.p_value);
  const std::vector<double> adjusted = HolmAdjusted(p_values);
  for (std::size_t i = 0; i < tests.size(); ++i) tests[i].adjusted_p_value = adjusted[i];
}

template <typename Test>
double SmallestAdjusted(const std::vector<Test>& tests) {
  double smallest = 1;
  for (const Test& test : tests) smallest = std::min(smallest, test.adjusted_p_value);
  return smallest;
}

ResidualList Inliers(const ResidualList& residuals) {
  ResidualList inliers;
  std::copy_if(residuals.begin(), residuals.end(), std::back_inserter(inliers),
               [](const CornerResidual& r) { return !r.is_outlier; });
  return inliers;
}

// Stephens' approximation for estimated mean and variance.
double AndersonDarlingP(double a) {
  if (a < 0.2) return 1 - std::exp(-13.436 + 101.14 * a - 223.73 * a * a);
  if (a < 0.34) return 1 - std::exp(-8.318 + 42.796 * a - 59.938 * a * a);
  if (a < 0.6) return std::exp(0.9177 - 4.279 * a - 1.38 * a * a);
  const double bounded = std::min(a, 10.0);  // beyond, its square term makes it grow again
  return std::max(1e-20, std::exp(1.2937 - 5.709 * bounded + 0.0186 * bounded * bounded));
}

// A^2 of sorted standardised values.
double AndersonDarling(const std::vector<double>& z) {
  const auto n = static_cast<double>(z.size());
  double sum = 0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    const auto log_tail = [](double x) { return std::log(std::max(NormalUpperTail(x), 1e-300)); };
    sum += (2.0 * static_cast<double>(i) + 1) * (log_tail(-z[i]) + log_tail(z[z.size() - 1 - i]));
  }
  return -n - sum / n;
}

}  // namespace

double NoiseReport::SmallestSpatialP() const { return SmallestAdjusted(spatial); }
double NoiseReport::SmallestTrendP() const { return SmallestAdjusted(trends); }

ChiSquareTest TestChiSquare(const ResidualList& residuals, int degrees) {
  ChiSquareTest test;
  test.degrees = degrees;
  for (const CornerResidual& r : residuals)
    if (!r.is_outlier) test.chi2 += r.whitened.squaredNorm();
  test.sigma0 = std::sqrt(test.chi2 / degrees);
  test.p_too_large = ChiSquareUpperTail(test.chi2, degrees);
  test.p_value = std::min(1.0, 2 * std::min(test.p_too_large, 1 - test.p_too_large));
  return test;
}

NormalityTest TestNormality(std::vector<double> values) {
  NormalityTest test;
  test.scalars = static_cast<int>(values.size());
  const auto n = static_cast<double>(values.size());
  if (n < 8) return test;
  double mean = 0, m2 = 0, m3 = 0, m4 = 0;
  for (const double value : values) mean += value / n;
  for (const double value : values) {
    const double d = value - mean;
    m2 += d * d / n;
    m3 += d * d * d / n;
    m4 += d * d * d * d / n;
  }
  if (!(m2 > 0)) return test;
  test.skewness = m3 / std::pow(m2, 1.5);
  test.excess_kurtosis = m4 / (m2 * m2) - 3;
  std::sort(values.begin(), values.end());
  const double sd = std::sqrt(m2 * n / (n - 1));
  for (double& value : values) value = (value - mean) / sd;
  test.statistic = AndersonDarling(values) * (1 + 0.75 / n + 2.25 / (n * n));
  test.p_value = AndersonDarlingP(test.statistic);
  return test;
}

NoiseReport TestNoise(const ResidualList& residuals, int degrees, int grid_columns) {
  TELESTRAIN_CHECK(degrees > 0 && grid_columns > 0, "no degrees of freedom or no board");
  NoiseReport report;
  const ResidualList inliers = Inliers(residuals);
  report.chi_square = TestChiSquare(inliers, degrees);
  std::vector<double> scalars;
  std::set<int> views;
  for (const CornerResidual& r : inliers) {
    scalars.insert(scalars.end(), {r.whitened.x(), r.whitened.y()});
    views.insert(r.view);
  }
  report.normality = TestNormality(std::move(scalars));
  for (const int view : views) {
    const ResidualList seen = OfView(inliers, view);
    const auto spatial = SpatialTestsOfView(seen, view, grid_columns);
    report.spatial.insert(report.spatial.end(), spatial.begin(), spatial.end());
    for (int component = 0; component < 2; ++component)
      report.trends.push_back(TrendOf(seen, view, component));
  }
  Adjust(report.spatial);
  Adjust(report.trends);
  return report;
}

}  // namespace telestrain
