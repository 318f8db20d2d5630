#include "target/corner_grid.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <vector>

#include "base/numbers.h"

namespace telestrain {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

// A window reaches so many sides of the square from its corner: neighbours share no pixel, so
// their errors are independent. Longer half edges would bend with the distortion.
constexpr double kWindowShare = 0.47;
constexpr double kLargestHalfWindow_px = 32;
// The part of a half edge that the next edge's blur must leave free, in blurs.
constexpr double kClearOfNextEdge = 4.5;
// What candidates may be off.
constexpr double kLargestCorrection_px = 1.0;
constexpr double kLargestMove = 0.2;  // of a square, from the first estimate
// From the grid's shape: in medians of the board's departures, which hold its lens's distortion,
// and in standard deviations of the corner.
constexpr double kDepartureMedians = 5, kDepartureSigmas = 4, kDepartureSlack_px = 0.01;
constexpr double kLargestSigmaRatio = 3;  // of the place, to the median
// To the board's medians. A cover over 1 % of a window, 20 % of the contrast off, doubles the
// residuals of a board with noise of 1 % of its contrast.
constexpr double kLargestResidualRatio = 1.6;
constexpr double kLeastContrastRatio = 0.5;
constexpr double kLargestBlurRatio = 1.8;
constexpr double kBlurSlack_px = 0.4;
constexpr double kLargestMisfit = 0.35;     // sigma over contrast
constexpr double kLargestBlurShare = 0.25;  // of the shorter distance between edges
constexpr int kLeastInEndLine = 3;
constexpr int kLeastCorners = 12, kLeastSpan = 3;
constexpr int kLeastForQuadratic = 24;
constexpr double kLargestClippedShare = 0.05;

template <typename Value>
double MedianOf(const CornerGrid& grid, const Value& value) {
  std::vector<double> values;
  values.reserve(grid.corners.size());
  for (const auto& [at, fit] : grid.corners) values.push_back(value(at, fit));
  return values.empty() ? 0 : Median(std::move(values));
}

double Parity(const LatticeIndex& at) { return (at.first + at.second) % 2 == 0 ? 1 : -1; }

// Half a side, shortened so that the window ends before the next edge's blur.
Vector2d HalfAxis(const Vector2d& side, double across_px, double blur_px) {
  const double free_share = 1 - kClearOfNextEdge * blur_px / std::max(across_px, 1.0);
  const double share = std::clamp(free_share, 0.3, kWindowShare);
  return side * std::min(share, kLargestHalfWindow_px / side.norm());
}

// Distance between the edges that run along the other axis.
double Across_px(const Matrix2d& axes, int axis) {
  return std::abs(axes.determinant()) / axes.col(1 - axis).norm();
}

// Enough of the image must lie on all sides of the corner.
bool IsInside(const SaddleFit& fit, const PixelRegion& region) {
  const double margin = 2 + 2 * fit.blur_px;
  const Vector2d& p = fit.point.pixel;
  return p.x() > region.x + margin && p.y() > region.y + margin &&
         p.x() < region.x + region.width - 1 - margin &&
         p.y() < region.y + region.height - 1 - margin;
}

const SaddleFit* Find(const CornerGrid& grid, int i, int j) {
  const auto found = grid.corners.find({i, j});
  return found == grid.corners.end() ? nullptr : &found->second;
}

// Where the corner (i, j) continues the corners before it that were fitted, two along one axis or
// three about a square; nothing without them.
std::optional<Vector2d> Continue(const CornerGrid& grid, int i, int j) {
  const auto at = [&](int di, int dj) { return Find(grid, i + di, j + dj); };
  for (const auto& [a, b, c] :
       {std::array{at(-1, 0), at(0, -1), at(-1, -1)}, std::array{at(1, -1), at(0, -1), at(1, -2)},
        std::array{at(-1, 0), at(-1, 0), at(-2, 0)}, std::array{at(0, -1), at(0, -1), at(0, -2)}})
    if (a && b && c) return a->point.pixel + b->point.pixel - c->point.pixel;
  return std::nullopt;
}

// A start from the fitted neighbours, where it agrees with the candidate `seen`.
SaddleStart StartLikeNeighbours(const CornerGrid& grid, const LatticeIndex& at,
                                const SaddleStart& seen) {
  SaddleStart start = seen;
  const auto [i, j] = at;
  const SaddleFit* like = Find(grid, i - 1, j);
  if (!like) like = Find(grid, i, j - 1);
  const auto place = Continue(grid, i, j);
  if (!like || !place) return seen;
  if ((*place - seen.pixel).norm() > kLargestCorrection_px) return seen;
  start.pixel = *place;
  start.angles_rad = Vector2d(like->angle_u_rad, like->angle_v_rad);
  return start;
}

void FitPlaces(const GrayImage& image, const PixelRegion& region, const CornerLattice& lattice,
               CornerGrid* grid) {
  const Matrix2d to_squares = lattice.axes_px.inverse();
  SaddleStart start;
  for (int j = lattice.first.second; j <= lattice.last.second; ++j)
    for (int i = lattice.first.first; i <= lattice.last.first; ++i) {
      const auto seen = lattice.pixels.find({i, j});
      start.pixel = seen != lattice.pixels.end() ? seen->second : lattice.Predict({i, j});
      start.half_axis_u_px =
          HalfAxis(lattice.axes_px.col(0), Across_px(lattice.axes_px, 0), start.blur_px);
      start.half_axis_v_px =
          HalfAxis(lattice.axes_px.col(1), Across_px(lattice.axes_px, 1), start.blur_px);
      const auto fit = FitSaddle(image, region, StartLikeNeighbours(*grid, {i, j}, start));
      if (!fit || !IsInside(*fit, region)) continue;
      const Vector2d move = to_squares * (fit->point.pixel - start.pixel);
      if (move.cwiseAbs().maxCoeff() > kLargestMove) continue;
      grid->corners.emplace(LatticeIndex{i, j}, *fit);
      start.blur_px = fit->blur_px;
    }
}

void UpdateMedians(CornerGrid* grid) {
  grid->sigma_gray = MedianOf(*grid, [](const auto&, const auto& fit) { return fit.sigma_gray; });
  grid->blur_px = MedianOf(*grid, [](const auto&, const auto& fit) { return fit.blur_px; });
  const double contrast = MedianOf(
      *grid, [](const auto& at, const auto& fit) { return Parity(at) * fit.contrast_gray; });
  grid->phase = contrast > 0 ? 1 : -1;
  grid->contrast_gray = std::abs(contrast);
}

void RemoveOddFits(CornerGrid* grid) {
  UpdateMedians(grid);
  std::erase_if(grid->corners, [grid](const auto& corner) {
    const SaddleFit& fit = corner.second;
    const double scatter = 1 + 4 / std::sqrt(2.0 * fit.pixels);
    const double contrast = grid->phase * Parity(corner.first) * fit.contrast_gray;
    return fit.sigma_gray > kLargestResidualRatio * scatter * grid->sigma_gray ||
           contrast < kLeastContrastRatio * grid->contrast_gray ||
           fit.blur_px > kLargestBlurRatio * grid->blur_px + kBlurSlack_px ||
           fit.blur_px < grid->blur_px / kLargestBlurRatio - kBlurSlack_px;
  });
}

void UpdateBox(CornerGrid* grid) {
  if (grid->corners.empty()) return;
  grid->first = grid->last = grid->corners.begin()->first;
  for (const auto& [at, fit] : grid->corners) {
    grid->first = {std::min(grid->first.first, at.first), std::min(grid->first.second, at.second)};
    grid->last = {std::max(grid->last.first, at.first), std::max(grid->last.second, at.second)};
  }
}

void RemoveThinEnds(CornerGrid* grid) {
  for (bool changed = true; changed && !grid->corners.empty();) {
    changed = false;
    UpdateBox(grid);
    for (const int axis : {0, 1})
      for (const LatticeIndex& end : {grid->first, grid->last}) {
        const auto on_line = [&](const auto& corner) {
          return axis == 0 ? corner.first.first == end.first : corner.first.second == end.second;
        };
        if (std::count_if(grid->corners.begin(), grid->corners.end(), on_line) >= kLeastInEndLine)
          continue;
        changed |= std::erase_if(grid->corners, on_line) > 0;
      }
  }
}

Eigen::Matrix<double, 6, 1> Monomials(const CornerGrid& grid, double i, double j) {
  const double u = i - 0.5 * (grid.first.first + grid.last.first);
  const double v = j - 0.5 * (grid.first.second + grid.last.second);
  return (Eigen::Matrix<double, 6, 1>() << 1, u, v, u * u, u * v, v * v).finished();
}

void FitShape(CornerGrid* grid) {
  const Eigen::Index terms = grid->Count() >= kLeastForQuadratic ? 6 : 3;
  Eigen::MatrixXd design(grid->Count(), terms), pixels(grid->Count(), 2);
  Eigen::Index row = 0;
  for (const auto& [at, fit] : grid->corners) {
    design.row(row) = Monomials(*grid, at.first, at.second).head(terms).transpose();
    pixels.row(row++) = fit.point.pixel.transpose();
  }
  grid->shape.setZero();
  grid->shape.leftCols(terms) = design.colPivHouseholderQr().solve(pixels).transpose();
}

bool IsTooSmall(const CornerGrid& grid) {
  return grid.Count() < kLeastCorners || grid.Width() < kLeastSpan || grid.Height() < kLeastSpan;
}

double Sigma_px(const SaddleFit& fit) { return std::sqrt(fit.point.covariance_px2.trace()); }

void RemoveMisplaced(CornerGrid* grid) {
  const auto departure = [grid](const LatticeIndex& at, const SaddleFit& fit) {
    return (fit.point.pixel - grid->At(at.first, at.second)).norm();
  };
  const double median = MedianOf(*grid, departure);
  const double sigma = MedianOf(*grid, [](const auto&, const auto& fit) { return Sigma_px(fit); });
  std::erase_if(grid->corners, [&](const auto& corner) {
    const double own = Sigma_px(corner.second);
    const double limit = kDepartureMedians * median + kDepartureSigmas * own + kDepartureSlack_px;
    return !(own < kLargestSigmaRatio * sigma) || !(departure(corner.first, corner.second) < limit);
  });
}

// Share of the pixels in the middle of the bright squares that sit at the format's ceiling, be it
// of 8, 10, 12 or 16 bits (shifted up into 16).
double ClippedShare(const GrayImage& image, const CornerGrid& grid, bool bright) {
  const float ceiling = image.max_gray > 255 ? image.max_gray - 63.5F : image.max_gray - 0.5F;
  const int reach = std::max(1, static_cast<int>(0.2 * std::min(Across_px(grid.Axes_px(), 0),
                                                                Across_px(grid.Axes_px(), 1))));
  int clipped = 0, count = 0;
  for (const auto& [at, fit] : grid.corners) {
    if (grid.IsBright(at.first, at.second) != bright) continue;
    const Vector2d middle = grid.At(at.first + 0.5, at.second + 0.5);
    const int cx = static_cast<int>(middle.x()), cy = static_cast<int>(middle.y());
    if (cx < reach || cy < reach || cx >= image.width - reach || cy >= image.height - reach)
      continue;
    const int side = 2 * reach + 1;
    for (int y = cy - reach; y <= cy + reach; ++y) {
      const float* row =
          image.pixels.data() + static_cast<std::ptrdiff_t>(y) * image.width + cx - reach;
      clipped += static_cast<int>(std::count_if(
          row, row + side, [=](float gray) { return bright ? gray >= ceiling : gray <= 0; }));
    }
    count += side * side;
  }
  return count > 0 ? clipped / static_cast<double>(count) : 0;
}

std::string WhySaturated(const GrayImage& image, const CornerGrid& grid) {
  for (const bool bright : {true, false}) {
    const double share = ClippedShare(image, grid, bright);
    if (share <= kLargestClippedShare) continue;
    const std::string percent = FormatFixed(100 * share, 0) + " % of the ";
    return bright ? "saturated: " + percent +
                        "bright squares' pixels are at the highest level; expose shorter"
                  : "underexposed: " + percent +
                        "dark squares' pixels are at level 0; expose longer or raise the offset";
  }
  return {};
}

}  // namespace

Vector2d CornerGrid::At(double i, double j) const { return shape * Monomials(*this, i, j); }

CornerGrid MeasureGrid(const GrayImage& image, const PixelRegion& region,
                       const CornerLattice& lattice) {
  CornerGrid grid;
  FitPlaces(image, region, lattice, &grid);
  RemoveOddFits(&grid);
  RemoveThinEnds(&grid);
  if (IsTooSmall(grid)) return grid;
  FitShape(&grid);
  RemoveMisplaced(&grid);
  RemoveThinEnds(&grid);
  if (IsTooSmall(grid)) return grid;
  UpdateMedians(&grid);
  FitShape(&grid);
  return grid;
}

std::string WhyUnfit(const GrayImage& image, const CornerGrid& grid) {
  if (IsTooSmall(grid))
    return "cut off, covered or unclear: " + std::to_string(grid.Count()) +
           " corners of one grid could be measured, at least " + std::to_string(kLeastCorners) +
           " over " + std::to_string(kLeastSpan) + " x " + std::to_string(kLeastSpan) +
           " places are needed";
  const double between_edges = std::min(Across_px(grid.Axes_px(), 0), Across_px(grid.Axes_px(), 1));
  const double limit = kLargestBlurShare * between_edges;
  if (grid.blur_px > limit)
    return "too blurred: edges of " + FormatFixed(grid.blur_px, 1) +
           " px standard deviation, at most " + FormatFixed(limit, 1) + " px for squares of " +
           FormatFixed(between_edges, 1) + " px";
  if (grid.sigma_gray > kLargestMisfit * grid.contrast_gray)
    return "no board in the view: a grid is there, but crossing edges do not explain its corners";
  return WhySaturated(image, grid);
}

}  // namespace telestrain
