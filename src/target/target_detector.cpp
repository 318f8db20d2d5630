#include "target/target_detector.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/numbers.h"
#include "target/board_labels.h"
#include "target/corner_lattice.h"
#include "target/saddle_candidates.h"
#include "target/saddle_fit.h"

namespace telestrain {
namespace {

using Eigen::Vector2d;

// Windows reach this far from a corner, in sides of the square: the rest keeps the next edge's
// blur out of the fit. Longer edges than 24 px gain little and would bend with the distortion.
constexpr double kWindowShare = 0.42;
constexpr double kLargestHalfWindow_px = 24;
constexpr double kLargestMove = 0.2;         // of a square, from the first estimate
constexpr double kLargestResidualRatio = 3;  // to the board's median
constexpr double kLeastContrastRatio = 0.3;
constexpr double kLargestBlurShare = 0.25;  // of the shorter distance between edges
constexpr double kLeastCornerShare = 0.9;
constexpr double kLeastEndLineShare = 0.7;
// Speckle and other textures make grids by accident: small, full of holes or crooked ones. The
// lens's distortion bends a true grid by some hundredths of a square.
constexpr int kLeastGrid = 9;
constexpr double kLeastFilling = 0.6;
constexpr double kLargestIrregularity = 0.1;

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
  saddles.reduction = side >= 80 ? 3 : side >= 36 ? 2 : 1;
  saddles.smoothing_px = std::clamp(0.05 * side / saddles.reduction, 1.0, 2.0);
  const double least = 1.8 * saddles.reduction;
  for (const double share : {0.25, 0.16, 0.1})
    saddles.radii_px.push_back(std::max(least, share * side));
  saddles.expected_count = std::max(8, search.columns * search.rows / 4);
  return saddles;
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

using Fits = std::vector<std::optional<SaddleFit>>;

Fits FitCorners(const GrayImage& image, const PixelRegion& region, const LabelledBoard& board) {
  SaddleStart start;
  const auto half_axis = [](const Vector2d& side) -> Vector2d {
    return side * std::min(kWindowShare, kLargestHalfWindow_px / side.norm());
  };
  start.half_axis_u_px = half_axis(board.axes_px.col(0));
  start.half_axis_v_px = half_axis(board.axes_px.col(1));
  const Eigen::Matrix2d to_squares = board.axes_px.inverse();
  Fits fits;
  for (const LabelledBoard::Corner& corner : board.corners) {
    start.pixel = corner.pixel;
    auto fit = FitSaddle(image, region, start);
    if (fit) {
      const Vector2d move = to_squares * (fit->point.pixel - corner.pixel);
      if (move.cwiseAbs().maxCoeff() > kLargestMove) fit.reset();
    }
    if (fit) start.blur_px = fit->blur_px;
    fits.push_back(fit);
  }
  return fits;
}

// Removes fits that do not look like the board's others: dust, a scratch, a shadow's edge. The
// contrast's sign must alternate over the board.
void RemoveOddFits(int columns, Fits* fits) {
  std::vector<double> sigmas, contrasts, signed_contrasts;
  const auto polarity = [columns](std::size_t i) {
    const int at = static_cast<int>(i);
    return (at % columns + at / columns) % 2 == 0 ? 1.0 : -1.0;
  };
  for (std::size_t i = 0; i < fits->size(); ++i) {
    if (!(*fits)[i]) continue;
    sigmas.push_back((*fits)[i]->sigma_gray);
    contrasts.push_back(std::abs((*fits)[i]->contrast_gray));
    signed_contrasts.push_back(polarity(i) * (*fits)[i]->contrast_gray);
  }
  if (sigmas.empty()) return;
  const double sigma = Median(sigmas), contrast = Median(contrasts);
  const double sign = Median(signed_contrasts) > 0 ? 1 : -1;
  for (std::size_t i = 0; i < fits->size(); ++i) {
    if (!(*fits)[i]) continue;
    const bool noisy = (*fits)[i]->sigma_gray > kLargestResidualRatio * sigma;
    const double own = sign * polarity(i) * (*fits)[i]->contrast_gray;
    if (noisy || own < kLeastContrastRatio * contrast) (*fits)[i].reset();
  }
}

std::string WhyTooBlurred(const Fits& fits, const LabelledBoard& board) {
  std::vector<double> blurs;
  for (const auto& fit : fits)
    if (fit) blurs.push_back(fit->blur_px);
  const double longest = std::max(board.axes_px.col(0).norm(), board.axes_px.col(1).norm());
  const double between_edges = std::abs(board.axes_px.determinant()) / longest;
  const double limit = kLargestBlurShare * between_edges;
  if (blurs.empty() || Median(blurs) <= limit) return {};
  return "too blurred: edges of " + FormatFixed(Median(blurs), 1) +
         " px standard deviation, at most " + FormatFixed(limit, 1) + " px for squares of " +
         FormatFixed(between_edges, 1) + " px";
}

// An end row or column that is mostly missing may not be the board's end at all.
bool EndLinesHold(const Fits& fits, int columns, int rows) {
  const auto filled = [&](int first, int stride, int count) {
    int found = 0;
    for (int i = 0; i < count; ++i)
      found += fits[static_cast<std::size_t>(first + i * stride)].has_value();
    return found >= kLeastEndLineShare * count;
  };
  return filled(0, 1, columns) && filled((rows - 1) * columns, 1, columns) &&
         filled(0, columns, rows) && filled(columns - 1, columns, rows);
}

std::string WhyNotUsable(const Fits& fits, const LabelledBoard& board, const TargetSearch& search) {
  const auto found = std::count_if(fits.begin(), fits.end(), [](const auto& f) { return bool(f); });
  const int count = search.columns * search.rows;
  const int least = static_cast<int>(std::ceil(kLeastCornerShare * count));
  if (std::string blurred = WhyTooBlurred(fits, board); !blurred.empty()) return blurred;
  if (found < least)
    return "partly covered or unclear: " + std::to_string(found) + " of " + std::to_string(count) +
           " corners could be measured, at least " + std::to_string(least) + " are needed";
  if (!EndLinesHold(fits, search.columns, search.rows))
    return "partly covered or unclear: much of an outer row or column of corners is missing";
  return {};
}

// The grid that is the board, or why there is none.
struct BoardGrid {
  std::optional<LabelledBoard> board;
  std::string rejected_because;
};

BoardGrid FindBoardGrid(const GrayImage& image, const TargetSearch& search) {
  const auto saddles = FindSaddles(image, BoardSaddles(search));
  auto lattices = FindLattices(saddles, 1.5 * LongestSide_px(search));
  std::erase_if(lattices, [](const CornerLattice& l) {
    return l.Count() < kLeastGrid || l.Filling() < kLeastFilling ||
           !(l.irregularity < kLargestIrregularity);
  });
  if (lattices.empty()) return {{}, "no board in the view"};
  std::vector<const CornerLattice*> whole;
  std::string reason;
  for (CornerLattice& lattice : lattices) {
    TrimSpuriousLines(search.columns, search.rows, &lattice);
    const std::string why = WhyNotWhole(lattice, search);
    if (why.empty()) whole.push_back(&lattice);
    if (reason.empty()) reason = why;  // of the largest grid that is not whole
  }
  if (whole.empty()) return {{}, reason};
  if (whole.size() > 1)
    return {{}, std::to_string(whole.size()) + " boards in the view where one is expected"};
  auto board = LabelBoard(*whole.front(), search);
  if (!board) return {{}, "turned too far from the nominal view to tell the board's ends apart"};
  return {std::move(board), {}};
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
  const BoardGrid grid = FindBoardGrid(image, search);
  observation.rejected_because = grid.rejected_because;
  if (!grid.board) return observation;
  Fits fits = FitCorners(image, search.region, *grid.board);
  RemoveOddFits(search.columns, &fits);
  observation.rejected_because = WhyNotUsable(fits, *grid.board, search);
  if (!observation.rejected_because.empty()) return observation;
  for (const auto& fit : fits)
    observation.corners.push_back(fit ? std::optional(fit->point) : std::nullopt);
  return observation;
}

}  // namespace telestrain
