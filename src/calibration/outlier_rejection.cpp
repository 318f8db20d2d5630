#include "calibration/outlier_rejection.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/numbers.h"

namespace telestrain {
namespace {

constexpr double kSigmaOfMedian = 1.4826;       // of a normal distribution
constexpr double kLargestRejectedShare = 0.25;  // of a board's corners; above it the board goes

// In units of the stated noise: corners that fit better than this are not told apart.
constexpr double kSmallestSigma = 0.05;
// An outlier is a mistake, not an imperfection: corners within this of the model are kept, whatever
// noise their fit claims.
constexpr double kOutlierFloor_px = 0.1;
// A board may be this much worse than the typical one before its corners count as outliers.
constexpr double kWorstBoardSigmas = 10;

constexpr const char* kDoesNotFit =
    "the board does not fit the array (more than a quarter of its corners are outliers)";

// Whitened residuals, column per corner, of every board.
std::vector<Eigen::Matrix2Xd> WhitenedErrors(const CalibrationData& data, const ArrayState& state) {
  std::vector<Eigen::Matrix2Xd> errors;
  for (const BoardData& board : data.boards) {
    Eigen::Matrix2Xd whitened = ReprojectionErrors_px(state, board);
    for (Eigen::Index i = 0; i < whitened.cols(); ++i)
      whitened.col(i) = (board.whitening[static_cast<std::size_t>(i)] * whitened.col(i)).eval();
    errors.push_back(std::move(whitened));
  }
  return errors;
}

std::vector<double> SizesOf(const std::vector<Eigen::Matrix2Xd>& errors) {
  std::vector<double> sizes;
  for (const Eigen::Matrix2Xd& board : errors)
    for (Eigen::Index i = 0; i < board.size(); ++i) sizes.push_back(std::abs(board.data()[i]));
  return sizes;
}

// Which corners of a board are outliers; the whole board when it does not fit the array.
struct BoardOutliers {
  std::vector<bool> remove;
  int count = 0;
  bool whole_board = false;
};

// `errors` are whitened, `sigma` is their robust scale over all boards. A board that is a little
// worse as a whole (blur, for instance) is judged by its own scale, so that it keeps its corners.
BoardOutliers FindOutliers(const Eigen::Matrix2Xd& errors, const Eigen::Matrix2Xd& errors_px,
                           double sigma, const OutlierOptions& options) {
  const double own_sigma = std::max(kSmallestSigma, kSigmaOfMedian * Median(SizesOf({errors})));
  const double limit =
      options.reject_sigmas * std::clamp(own_sigma, sigma, kWorstBoardSigmas * sigma);
  BoardOutliers outliers;
  for (Eigen::Index i = 0; i < errors.cols(); ++i) {
    outliers.remove.push_back(errors.col(i).cwiseAbs().maxCoeff() > limit &&
                              errors_px.col(i).norm() > kOutlierFloor_px);
    outliers.count += outliers.remove.back();
  }
  outliers.whole_board =
      outliers.count > kLargestRejectedShare * static_cast<double>(errors.cols());
  return outliers;
}

// By mrcal's own rule.
BoardOutliers FindMrcalOutliers(const Eigen::Matrix2Xd& errors, double limit) {
  BoardOutliers outliers;
  for (Eigen::Index i = 0; i < errors.cols(); ++i) {
    outliers.remove.push_back(errors.col(i).cwiseAbs().maxCoeff() > limit);
    outliers.count += outliers.remove.back();
  }
  return outliers;
}

bool KeepsTooFew(const BoardData& board, const BoardOutliers& outliers, int grid_columns) {
  std::vector<int> kept;
  for (std::size_t i = 0; i < outliers.remove.size(); ++i)
    if (!outliers.remove[i]) kept.push_back(board.corner[i]);
  return !GiveAnAffineImage(kept, grid_columns);
}

// A board that does not fit pulls the pose of its image away from the others: of every image only
// the worst such board goes, and the others are judged again without it. An image that has lost one
// so and still has one that does not fit goes whole: its boards cannot tell which of them is wrong.
void SpareItsNeighbours(const CalibrationData& data, const std::vector<Eigen::Matrix2Xd>& errors,
                        std::vector<BoardOutliers>& found) {
  std::map<int, std::size_t> worst;  // of an image
  const auto misfit = [&](std::size_t b) {
    return errors[b].squaredNorm() / static_cast<double>(errors[b].cols());
  };
  for (std::size_t b = 0; b < found.size(); ++b) {
    if (!found[b].whole_board) continue;
    const auto at = worst.try_emplace(data.boards[b].image, b).first;
    if (misfit(b) > misfit(at->second)) at->second = b;
  }
  const auto has_lost_one = [&](int image) {
    return std::any_of(data.rejected.begin(), data.rejected.end(),
                       [&](const RejectedObservation& r) {
                         return r.image == data.images[static_cast<std::size_t>(image)].image &&
                                r.reason == kDoesNotFit;
                       });
  };
  for (std::size_t b = 0; b < found.size(); ++b) {
    const auto at = worst.find(data.boards[b].image);
    if (at == worst.end() || at->second == b) continue;
    found[b] = {};
    found[b].whole_board = has_lost_one(at->first);
    found[b].count = found[b].whole_board ? static_cast<int>(errors[b].cols()) : 0;
    found[b].remove.assign(static_cast<std::size_t>(errors[b].cols()), false);
  }
}

double SampleSigma(const std::vector<double>& sizes) {
  double squares = 0;
  for (const double size : sizes) squares += size * size;
  return std::sqrt(squares / static_cast<double>(sizes.size()));
}

}  // namespace

double RobustSigma(const CalibrationData& data, const ArrayState& state) {
  return kSigmaOfMedian * Median(SizesOf(WhitenedErrors(data, state)));
}

int RemoveOutliers(const Session& session, const ArrayState& state, const OutlierOptions& options,
                   CalibrationData& data) {
  const auto errors = WhitenedErrors(data, state);
  const std::vector<double> sizes = SizesOf(errors);
  const bool by_mrcal = options.scale == OutlierScale::kMrcal;
  const double sigma =
      by_mrcal ? SampleSigma(sizes) : std::max(kSmallestSigma, kSigmaOfMedian * Median(sizes));
  if (*std::max_element(sizes.begin(), sizes.end()) <= options.sigmas * sigma) return 0;
  std::vector<BoardOutliers> found;
  for (std::size_t b = 0; b < data.boards.size(); ++b)
    found.push_back(by_mrcal ? FindMrcalOutliers(errors[b], options.reject_sigmas * sigma)
                             : FindOutliers(errors[b], ReprojectionErrors_px(state, data.boards[b]),
                                            sigma, options));
  if (!by_mrcal) SpareItsNeighbours(data, errors, found);
  int removed = 0;
  std::vector<bool> drop_board(data.boards.size(), false);
  for (std::size_t b = 0; b < data.boards.size(); ++b) {
    BoardData& board = data.boards[b];
    BoardOutliers& outliers = found[b];
    if (outliers.count == 0) continue;
    const bool too_few = KeepsTooFew(board, outliers, data.target.columns);
    outliers.whole_board = outliers.whole_board || too_few;
    if (outliers.whole_board) outliers.count = static_cast<int>(board.Count());
    drop_board[b] = outliers.whole_board;
    removed += outliers.count;
    data.rejected.push_back({data.images[static_cast<std::size_t>(board.image)].image,
                             session.views[static_cast<std::size_t>(board.view)].name,
                             too_few                ? "too few corners of the board are no outliers"
                             : outliers.whole_board ? kDoesNotFit
                                                    : "corners are outliers",
                             outliers.count, outliers.whole_board});
    board.RemoveCorners(outliers.remove);
  }
  for (std::size_t b = data.boards.size(); b-- > 0;)
    if (drop_board[b]) data.boards.erase(data.boards.begin() + static_cast<std::ptrdiff_t>(b));
  data.DropUndeterminedImages(session);
  return removed;
}

}  // namespace telestrain
