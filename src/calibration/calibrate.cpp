#include "calibration/calibrate.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "base/numbers.h"
#include "geometry/rotation.h"

namespace telestrain {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kOutlierRounds = 6;
constexpr double kLargestRejectedShare = 0.25;  // of a board's corners; above it the board goes

// In units of the stated noise: corners that fit better than this are not told apart.
constexpr double kSmallestSigma = 0.05;
// An outlier is a mistake, not an imperfection: corners within this of the model are kept, whatever
// noise their fit claims.
constexpr double kOutlierFloor_px = 0.1;
// A board may be this much worse than the typical one before its corners count as outliers.
constexpr double kWorstBoardSigmas = 10;

// The order in which coefficients are offered to the data.
constexpr std::array<DistortionModel, 4> kModelSteps{{{true, false, false, false, false},
                                                      {true, false, true, true, false},
                                                      {true, true, true, true, false},
                                                      {true, true, true, true, true}}};

ArrayState StateFromSeed(const Session& session, const ArraySeed& seed) {
  ArrayState state;
  state.array.lens = seed.lens;
  state.array.views = seed.views;
  state.poses = seed.poses;
  state.stage_axis_in_array = session.stage_axis_in_array;
  return state;
}

BundleOptions OptionsFor(const Session& session, const DistortionModel& model) {
  BundleOptions options;
  options.model = model;
  options.stage_sigma_mm = session.stage_sigma_mm;
  return options;
}

double MedianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

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

double RobustSigma(const Eigen::Matrix2Xd& errors) {
  std::vector<double> sizes;
  for (Eigen::Index i = 0; i < errors.size(); ++i) sizes.push_back(std::abs(errors.data()[i]));
  return std::max(kSmallestSigma, 1.4826 * MedianOf(std::move(sizes)));
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
                           double sigma, const CalibrationOptions& options) {
  const double own_sigma = RobustSigma(errors);
  const double limit =
      options.outlier_reject_sigmas * std::clamp(own_sigma, sigma, kWorstBoardSigmas * sigma);
  BoardOutliers outliers;
  for (Eigen::Index i = 0; i < errors.cols(); ++i) {
    outliers.remove.push_back(errors.col(i).cwiseAbs().maxCoeff() > limit &&
                              errors_px.col(i).norm() > kOutlierFloor_px);
    outliers.count += outliers.remove.back();
  }
  outliers.whole_board =
      outliers.count > kLargestRejectedShare * static_cast<double>(errors.cols());
  if (outliers.whole_board) outliers.count = static_cast<int>(errors.cols());
  return outliers;
}

// mrcal's rule with a robust scale: if any coordinate is beyond the first limit, every corner
// beyond the second is removed. Returns how many were.
int RemoveOutliers(const Session& session, const ArrayState& state,
                   const CalibrationOptions& options, CalibrationData& data) {
  const auto errors = WhitenedErrors(data, state);
  std::vector<double> sizes;
  for (const auto& board : errors)
    for (Eigen::Index i = 0; i < board.size(); ++i) sizes.push_back(std::abs(board.data()[i]));
  const double sigma = std::max(kSmallestSigma, 1.4826 * MedianOf(sizes));
  if (*std::max_element(sizes.begin(), sizes.end()) <= options.outlier_sigmas * sigma) return 0;
  int removed = 0;
  std::vector<bool> drop_board(data.boards.size(), false);
  for (std::size_t b = 0; b < data.boards.size(); ++b) {
    BoardData& board = data.boards[b];
    const BoardOutliers outliers =
        FindOutliers(errors[b], ReprojectionErrors_px(state, board), sigma, options);
    if (outliers.count == 0) continue;
    drop_board[b] = outliers.whole_board;
    removed += outliers.count;
    data.rejected.push_back({data.images[static_cast<std::size_t>(board.image)].image,
                             session.views[static_cast<std::size_t>(board.view)].name,
                             outliers.whole_board
                                 ? "the board does not fit the array (more than a quarter of its "
                                   "corners are outliers)"
                                 : "corners are outliers",
                             outliers.count, outliers.whole_board});
    board.RemoveCorners(outliers.remove);
  }
  for (std::size_t b = data.boards.size(); b-- > 0;)
    if (drop_board[b]) data.boards.erase(data.boards.begin() + static_cast<std::ptrdiff_t>(b));
  data.DropUndeterminedImages(session);
  return removed;
}

Status RequireEnoughPoses(const CalibrationData& data) {
  constexpr std::size_t kMinImages = 3;
  if (data.images.size() >= kMinImages) return {};
  return EstimationFailed("only " + std::to_string(data.images.size()) +
                          " calibration images show the target in two views or more, at least " +
                          std::to_string(kMinImages) +
                          " are needed; detection.json lists why the others were rejected");
}

// The seed knows every travel to a few micrometres; a table that says something else is wrong.
Status RequireStatedTravels(const Session& session, const CalibrationData& data,
                            const ArraySeed& seed) {
  const Eigen::Vector3d axis = session.stage_axis_in_array.normalized();
  std::map<std::string, std::size_t> first_of_pose;
  for (std::size_t k = 0; k < data.images.size(); ++k) {
    const auto [at, is_first] = first_of_pose.try_emplace(data.images[k].pose, k);
    if (is_first) continue;
    const double travel_mm = data.images[k].stage_mm - data.images[at->second].stage_mm;
    const Eigen::Vector3d moved =
        seed.poses[k].origin_in_array_mm - seed.poses[at->second].origin_in_array_mm;
    if ((moved - axis * travel_mm).norm() < 0.1 + 0.1 * std::abs(travel_mm)) continue;
    return EstimationFailed(
        "calibration.csv: from " + data.images[at->second].image + " to " + data.images[k].image +
        " (pose '" + data.images[k].pose + "') the target moved " + FormatFixed(moved.norm(), 3) +
        " mm, " + FormatFixed(axis.dot(moved), 3) + " mm of it along the stage; stage_mm says " +
        FormatFixed(travel_mm, 3) +
        " mm: check stage_mm and pose of these rows and [stage] axis_in_array");
  }
  return {};
}

// Seeds and solves with a flexible lens until no outlier is left.
Result<BundleResult> SolveWithoutOutliers(const Session& session, const CalibrationOptions& options,
                                          Calibration& calibration) {
  for (int round = 0;; ++round) {
    TELESTRAIN_ASSIGN_OR_RETURN(calibration.seed, SeedArray(session, calibration.data));
    TELESTRAIN_RETURN_IF_ERROR(RequireStatedTravels(session, calibration.data, calibration.seed));
    TELESTRAIN_ASSIGN_OR_RETURN(
        BundleResult solved,
        AdjustBundle(calibration.data, StateFromSeed(session, calibration.seed),
                     OptionsFor(session, kModelSteps[1])));
    if (RemoveOutliers(session, solved.state, options, calibration.data) == 0) return solved;
    TELESTRAIN_RETURN_IF_ERROR(RequireEnoughPoses(calibration.data));
    if (round == kOutlierRounds)
      return EstimationFailed("after " + std::to_string(kOutlierRounds) +
                              " rounds of removing outliers there are still new ones; the corners "
                              "do not fit one rigid array: look at calibration images that moved "
                              "during exposure");
  }
}

// P(chi-square with `degrees` degrees of freedom > x), by its finite series.
double TailProbability(double x, int degrees) {
  if (!(x > 0)) return 1;
  const bool is_odd = degrees % 2 == 1;
  double sum = 0, term = is_odd ? std::sqrt(2 * x / kPi) : 1.0;
  for (int i = is_odd ? 1 : 0; i < degrees; i += 2) {
    if (i > 1) term *= x / i;
    if (i + 1 < degrees || !is_odd) sum += term;
  }
  return (is_odd ? std::erfc(std::sqrt(x / 2)) : 0.0) + std::exp(-x / 2) * sum;
}

// Frees coefficients step by step as long as the likelihood-ratio test wants them (MODEL.md 6).
Result<BundleResult> ChooseModel(const Session& session, const CalibrationOptions& options,
                                 const ArrayState& start, Calibration& calibration) {
  ArrayState plain = start;
  plain.array.lens.distortion = {};
  TELESTRAIN_ASSIGN_OR_RETURN(BundleResult best,
                              AdjustBundle(calibration.data, plain, OptionsFor(session, {})));
  calibration.model_tests.push_back({{}, 0, best.chi2, 0, 1, true});
  for (const DistortionModel& model : kModelSteps) {
    TELESTRAIN_ASSIGN_OR_RETURN(const BundleResult next, AdjustBundle(calibration.data, best.state,
                                                                      OptionsFor(session, model)));
    ModelTest test;
    test.model = model;
    test.added_parameters = next.parameter_count - best.parameter_count;
    test.chi2 = next.chi2;
    const double variance = next.chi2 / (next.residual_count - next.parameter_count);
    test.f_statistic = (best.chi2 - next.chi2) / test.added_parameters / variance;
    test.p_value = TailProbability(test.f_statistic * test.added_parameters, test.added_parameters);
    test.accepted = test.p_value < options.significance;
    calibration.model_tests.push_back(test);
    if (test.accepted) best = next;
  }
  return best;
}

// Moves the array frame rigidly to where the views fit the nominal ones best; no pixel changes.
void AlignToNominal(const Session& session, ArrayState& state) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < state.array.views.size(); ++i)
    sum += session.NominalTelecentricView(session.views[i]).Rotation().transpose() *
           state.array.views[i].Rotation();
  const Eigen::Matrix3d turn = NearestRotation(sum);  // aligned_from_array
  Eigen::Matrix3d normal = 1e-9 * Eigen::Matrix3d::Identity();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < state.array.views.size(); ++i) {
    TelecentricView& view = state.array.views[i];
    view.axes_in_array = (view.axes_in_array * turn.transpose()).eval();
    const NominalView& nominal = session.views[i];
    const Eigen::Vector2d middle = state.array.lens.IdealFromPixel(nominal.region.Middle());
    normal += view.axes_in_array.transpose() * view.axes_in_array;
    right += view.axes_in_array.transpose() * (view.Ideal(nominal.center_in_array_mm) - middle);
  }
  const Eigen::Vector3d shift = normal.ldlt().solve(right);
  for (TelecentricView& view : state.array.views) view.offset_mm -= view.axes_in_array * shift;
  for (TargetPose& pose : state.poses) {
    pose.array_from_target = turn * pose.array_from_target;
    pose.origin_in_array_mm = turn * pose.origin_in_array_mm + shift;
  }
  state.stage_axis_in_array = turn * state.stage_axis_in_array;
}

StageEvidence StudyStage(const Session& session, const CalibrationData& data,
                         const BundleResult& bundle) {
  const ArrayState& state = bundle.state;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const TargetPose& pose : state.poses) normal += pose.array_from_target.col(2);
  normal.normalize();
  std::map<std::string, std::size_t> first_of_pose;
  double own = 0, twin = 0;
  int moves = 0;
  for (std::size_t k = 0; k < data.images.size(); ++k) {
    const auto [at, is_first] = first_of_pose.try_emplace(data.images[k].pose, k);
    const double travel_mm = data.images[k].stage_mm - data.images[at->second].stage_mm;
    if (is_first || travel_mm == 0) continue;
    const Eigen::Vector3d moved =
        state.poses[k].origin_in_array_mm - state.poses[at->second].origin_in_array_mm;
    const Eigen::Vector3d expected = state.stage_axis_in_array * travel_mm;
    const Eigen::Vector3d mirrored = moved - 2 * normal.dot(moved) * normal;
    own += (moved - expected).squaredNorm();
    twin += (mirrored - expected).squaredNorm();
    ++moves;
  }
  StageEvidence evidence;
  if (moves == 0) return evidence;
  const Eigen::Vector3d nominal = session.stage_axis_in_array.normalized();
  evidence.axis_to_nominal_deg =
      std::acos(std::clamp(nominal.dot(state.stage_axis_in_array), -1.0, 1.0)) * 180 / kPi;
  evidence.rms_travel_error_um = 1000 * std::sqrt(own / (3.0 * moves));
  const double variance = session.stage_sigma_mm * session.stage_sigma_mm;
  evidence.twin_chi2_ratio = (bundle.chi2 + (twin - own) / variance) / bundle.chi2;
  return evidence;
}

struct ErrorSums {
  double squares = 0, norms = 0, largest = 0;
  int corners = 0;
  void Add(const Eigen::Vector2d& error) {
    squares += error.squaredNorm();
    norms += error.norm();
    largest = std::max(largest, error.norm());
    ++corners;
  }
  ReprojectionStatistics Statistics() const {
    if (corners == 0) return {};
    return {std::sqrt(squares / (2.0 * corners)), norms / corners, largest, corners};
  }
};

void CollectStatistics(const Session& session, Calibration& calibration) {
  ErrorSums all;
  std::vector<ErrorSums> of_view(session.views.size());
  const double floor_px2 = calibration.data.floor_px * calibration.data.floor_px;
  double variance_sum_px2 = 0;
  for (const BoardData& board : calibration.data.boards) {
    const Eigen::Matrix2Xd errors = ReprojectionErrors_px(calibration.bundle.state, board);
    ErrorSums of_board;
    for (Eigen::Index i = 0; i < errors.cols(); ++i) {
      for (ErrorSums* sums : {&all, &of_view[static_cast<std::size_t>(board.view)], &of_board})
        sums->Add(errors.col(i));
      const Eigen::Matrix2d& w = board.whitening[static_cast<std::size_t>(i)];
      variance_sum_px2 += (w.transpose() * w).inverse().trace() / 2 - floor_px2;
    }
    calibration.of_board.push_back(of_board.Statistics());
  }
  calibration.all = all.Statistics();
  for (const ErrorSums& sums : of_view) calibration.of_view.push_back(sums.Statistics());
  const BundleResult& bundle = calibration.bundle;
  const double freedom = 1.0 - static_cast<double>(bundle.parameter_count) / bundle.residual_count;
  calibration.expected_rms_px = std::sqrt(variance_sum_px2 / all.corners * freedom);
  calibration.sigma0 = std::sqrt(bundle.chi2 / (bundle.residual_count - bundle.parameter_count));
}

}  // namespace

Result<Calibration> Calibrate(const Session& session,
                              const std::vector<BoardObservation>& observations,
                              const CalibrationOptions& options) {
  Calibration calibration;
  TELESTRAIN_ASSIGN_OR_RETURN(calibration.data, CollectCalibrationData(session, observations));
  TELESTRAIN_RETURN_IF_ERROR(RequireEnoughPoses(calibration.data));
  TELESTRAIN_ASSIGN_OR_RETURN(const BundleResult flexible,
                              SolveWithoutOutliers(session, options, calibration));
  TELESTRAIN_ASSIGN_OR_RETURN(BundleResult chosen,
                              ChooseModel(session, options, flexible.state, calibration));
  AlignToNominal(session, chosen.state);
  BundleOptions final_options = OptionsFor(session, chosen.state.array.model);
  final_options.want_covariance = true;
  TELESTRAIN_ASSIGN_OR_RETURN(calibration.bundle,
                              AdjustBundle(calibration.data, chosen.state, final_options));
  CollectStatistics(session, calibration);
  for (const RejectedObservation& rejected : calibration.data.rejected)
    calibration.corners_rejected += rejected.corners;
  calibration.stage = StudyStage(session, calibration.data, calibration.bundle);
  const double inflation = std::max(1.0, calibration.sigma0);
  calibration.bundle.state.array.covariance *= inflation * inflation;
  return calibration;
}

}  // namespace telestrain
