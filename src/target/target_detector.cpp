#include "target/target_detector.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/numbers.h"
#include "target/board_ends.h"
#include "target/board_labels.h"
#include "target/corner_grid.h"
#include "target/corner_lattice.h"
#include "target/saddle_candidates.h"

namespace telestrain {
namespace {

using Eigen::Vector2d;

// Speckle and other textures make grids by accident: small, full of holes or crooked ones. The
// lens's distortion bends a true grid by some hundredths of a square.
constexpr int kLeastGrid = 9;
constexpr double kLeastFilling = 0.3;
constexpr double kLargestIrregularity = 0.1;
constexpr std::size_t kMostGrids = 4;  // looked at, largest first

double ShortestSide_px(const TargetSearch& search) {
  return search.square_mm * search.nominal_px_per_mm.jacobiSvd().singularValues()[1];
}
double LongestSide_px(const TargetSearch& search) {
  return search.square_mm * search.nominal_px_per_mm.jacobiSvd().singularValues()[0];
}

void CheckSearch(const GrayImage& image, const TargetSearch& search) {
  const PixelRegion& r = search.region;
  TELESTRAIN_CHECK(r.x >= 0 && r.y >= 0 && r.width > 0 && r.height > 0 &&
                       r.x + r.width <= image.width && r.y + r.height <= image.height,
                   "the view's region leaves the image");
}

// A board tilted by 45 deg more than nominal has sides down to a third of the nominal ones, so the
// circles and the smoothing start well below them.
SaddleSearch BoardSaddles(const TargetSearch& search) {
  const double side = ShortestSide_px(search);
  SaddleSearch saddles;
  saddles.region = search.region;
  saddles.reduction = side >= 54 ? 3 : side >= 36 ? 2 : 1;
  saddles.smoothing_px = std::clamp(0.05 * side / saddles.reduction, 1.0, 2.0);
  const double least = 1.8 * saddles.reduction;
  for (const double share : {0.25, 0.16, 0.1})
    saddles.radii_px.push_back(std::max(least, share * side));
  saddles.expected_count = std::max(8, search.columns * search.rows / 4);
  return saddles;
}

// A grid of the view that may be the board, with its labels.
struct LabelledGrid {
  CornerGrid grid;
  BoardLabels labels;
};

LabelledGrid Examine(const GrayImage& image, const CornerLattice& lattice,
                     const TargetSearch& search) {
  LabelledGrid board;
  board.labels.refused_because = WhyAnotherPattern(lattice, search);
  if (!board.labels.refused_because.empty()) return board;
  board.grid = MeasureGrid(image, search.region, lattice);
  board.labels.refused_because = WhyUnfit(image, board.grid);
  if (!board.labels.refused_because.empty()) return board;
  board.labels = LabelGrid(board.grid, FindBoardEnds(image, search.region, board.grid), search);
  return board;
}

// What a view without a grid shows, and what was looked for there.
std::string WhyNoGrid(const GrayImage& image, const TargetSearch& search) {
  const PixelRegion& region = search.region;
  std::vector<float> levels;
  for (int y = region.y; y < region.y + region.height; y += 3)
    for (int x = region.x; x < region.x + region.width; x += 3) levels.push_back(image.At(x, y));
  std::sort(levels.begin(), levels.end());
  const auto at = [&](double share) {
    return static_cast<double>(
        levels[static_cast<std::size_t>(share * static_cast<double>(levels.size() - 1))]);
  };
  const auto full = std::count(levels.begin(), levels.end(), image.max_gray);
  const double full_percent = 100 * static_cast<double>(full) / static_cast<double>(levels.size());
  std::string reason = "no board in the view: 98 % of its grey levels lie from " +
                       FormatFixed(at(0.01), 0) + " to " + FormatFixed(at(0.99), 0) + " of " +
                       FormatFixed(static_cast<double>(image.max_gray), 0);
  if (full_percent >= 1)
    reason += ", " + FormatFixed(full_percent, 0) + " % of its pixels are saturated";
  const double side = LongestSide_px(search);
  return reason + "; looked for squares of " + FormatFixed(side, side < 10 ? 1 : 0) + " px";
}

std::vector<CornerLattice> FindGrids(const GrayImage& image, const TargetSearch& search) {
  auto lattices =
      FindLattices(FindSaddles(image, BoardSaddles(search)), 1.5 * LongestSide_px(search));
  std::erase_if(lattices, [](const CornerLattice& l) {
    return l.Count() < kLeastGrid || l.Filling() < kLeastFilling ||
           !(l.irregularity < kLargestIrregularity);
  });
  for (CornerLattice& lattice : lattices) TrimSpuriousLines(search.columns, search.rows, &lattice);
  if (!lattices.empty()) JoinSeparated(search.columns, search.rows, &lattices);
  return lattices;
}

// The grid that is the board. When none is, or more than one, only the reason is set.
LabelledGrid FindBoard(const GrayImage& image, const TargetSearch& search) {
  std::vector<LabelledGrid> boards;
  const auto lattices = FindGrids(image, search);
  std::string reason = lattices.empty() ? WhyNoGrid(image, search) : "";
  for (std::size_t i = 0; i < std::min(lattices.size(), kMostGrids); ++i) {
    LabelledGrid board = Examine(image, lattices[i], search);
    if (i == 0) reason = board.labels.refused_because;  // of the largest grid
    if (board.labels.refused_because.empty()) boards.push_back(std::move(board));
  }
  if (boards.size() == 1) return std::move(boards.front());
  LabelledGrid none;
  none.labels.refused_because =
      boards.empty() ? reason
                     : std::to_string(boards.size()) + " boards in the view where one is expected";
  return none;
}

}  // namespace

BoardObservation DetectBoard(const GrayImage& image, const TargetSearch& search) {
  CheckSearch(image, search);
  TELESTRAIN_CHECK(search.columns >= 2 && search.rows >= 2 && search.square_mm > 0,
                   "a board has at least 2 x 2 corners and squares of positive size");
  BoardObservation observation;
  observation.view = search.view;
  if (!(ShortestSide_px(search) >= 4)) {
    observation.rejected_because = "the nominal view shows squares of less than 4 px";
    return observation;
  }
  const LabelledGrid board = FindBoard(image, search);
  observation.rejected_because = board.labels.refused_because;
  if (!observation.rejected_because.empty()) return observation;
  observation.corners.resize(static_cast<std::size_t>(search.columns * search.rows));
  for (const auto& [at, fit] : board.grid.corners) {
    const Eigen::Vector2i place = board.labels.ColumnAndRow(at);
    TELESTRAIN_CHECK(
        place.x() >= 0 && place.y() >= 0 && place.x() < search.columns && place.y() < search.rows,
        "a label lies outside the board");
    observation.corners[static_cast<std::size_t>(place.y() * search.columns + place.x())] =
        fit.point;
  }
  return observation;
}

}  // namespace telestrain
