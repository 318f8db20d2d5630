#include "calibration/calibrate.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/numbers.h"
#include "calibration/copied_images.h"
#include "calibration/weak_input.h"
#include "geometry/rotation.h"

namespace telestrain {
namespace {

constexpr int kOutlierRounds = 8;
constexpr double kRobustSigmas = 3;  // scale of Cauchy's loss
constexpr int kScaleRounds = 2;
// Where the search for outliers starts: flexible enough for any real lens.
const LensModel kSearchModel{{true, true, true, true, false}};
// A parameter that stays more uncertain than this is not determined: the seed knows it better.
constexpr double kUselessScale = 1e-3, kUselessTurn_rad = 0.01, kUselessOffset_mm = 0.1;

BundleOptions OptionsFor(const Session& session, const CalibrationOptions& options) {
  BundleOptions bundle;
  bundle.estimate_bow = options.board_warp;
  bundle.stage_sigma_mm = session.stage_sigma_mm;
  return bundle;
}

Status RequireEnoughPoses(const CalibrationData& data) {
  constexpr std::size_t kMinImages = 3;
  if (data.images.size() >= kMinImages) return {};
  std::set<std::string> copies;
  for (const RejectedObservation& rejected : data.rejected)
    if (rejected.reason.starts_with("a copy of")) copies.insert(rejected.image);
  return EstimationFailed("only " + std::to_string(data.images.size()) +
                          " calibration images show the target in two views or more, at least " +
                          std::to_string(kMinImages) + " are needed; " +
                          (copies.empty()
                               ? "detection.json lists why the others were rejected"
                               : std::to_string(copies.size()) + " are copies of others (" +
                                     *copies.begin() + ", …): take each pose anew"));
}

// The paper's Fig. 5: if the rotation between two views varies more as chosen than with one of them
// flipped, the boards are not those of one rigid target before one rigid array.
Status RequireRigidArray(const Session& session, const BranchScreening& screening) {
  constexpr double kLargestSpread_deg = 1;  // corner noise of 0.8 px makes 0.2 deg at 30 deg tilt
  if (screening.chosen_spread_deg < kLargestSpread_deg ||
      screening.chosen_spread_deg < screening.mixed_spread_deg)
    return {};
  const auto name = [&](std::size_t i) {
    return session.views[static_cast<std::size_t>(screening.worst_pair[i])].name;
  };
  return EstimationFailed("the boards are not those of one rigid target: the rotation between " +
                          name(0) + " and " + name(1) + " varies by " +
                          FormatFixed(screening.chosen_spread_deg, 1) +
                          " deg over the images whichever side they are seen from; check that "
                          "calibration.csv names images of one set-up and one target");
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
    const Eigen::Vector2d middle = state.array.LensOf(i).IdealFromPixel(nominal.region.Middle());
    normal += view.axes_in_array.transpose() * view.axes_in_array;
    right += view.axes_in_array.transpose() * (view.Ideal(nominal.center_in_array_mm) - middle);
  }
  const Eigen::Vector3d shift = normal.ldlt().solve(right);
  for (TelecentricView& view : state.array.views) {
    view.offset_mm -= view.axes_in_array * shift;
    view.depth_offset_mm -= view.depth_sense * view.RayDirection().dot(shift);
  }
  for (TargetPose& pose : state.poses) {
    pose.array_from_target = turn * pose.array_from_target;
    pose.origin_in_array_mm = turn * pose.origin_in_array_mm + shift;
  }
  state.stage_axis_in_array = turn * state.stage_axis_in_array;
}

// Failures of the solver get their cause in words where one is found.
template <typename T>
Result<T> Explain(const Session& session, const CalibrationData& data,
                  const std::vector<TargetPose>& poses, Result<T> result) {
  if (result || result.error().kind != ErrorKind::kEstimationFailed) return result;
  return EstimationFailed(ExplainWeakInput(session, data, poses, result.error().message));
}

// A solution that gross mistakes do not pull: least squares first, then Cauchy's loss with a scale
// that follows the median residual down, then whatever the residuals still want of the model, so
// that what a model lacks is not taken for mistakes.
Result<ArrayState> SolveRobustly(const Session& session, const CalibrationData& data,
                                 const ArrayState& seed, const CalibrationOptions& choices) {
  BundleOptions options = OptionsFor(session, choices);
  options.model = kSearchModel;
  options.must_converge = false;
  TELESTRAIN_ASSIGN_OR_RETURN(BundleResult solved, AdjustBundle(data, seed, options));
  for (int round = 0; round < kScaleRounds; ++round) {
    options.robust_sigmas = kRobustSigmas * std::max(1.0, RobustSigma(data, solved.state));
    TELESTRAIN_ASSIGN_OR_RETURN(solved, AdjustBundle(data, solved.state, options));
  }
  TELESTRAIN_ASSIGN_OR_RETURN(const ChosenModel chosen,
                              ChooseModel(data, solved.state, options, choices.model_choice));
  return chosen.bundle.state;
}

// Seeds and solves until no outlier is left.
Result<ArrayState> SolveWithoutOutliers(const Session& session, const CalibrationOptions& options,
                                        Calibration& calibration) {
  CalibrationData& data = calibration.data;
  for (int round = 0;; ++round) {
    TELESTRAIN_ASSIGN_OR_RETURN(calibration.seed, SeedArray(session, data));
    if (round == 0)
      TELESTRAIN_RETURN_IF_ERROR(RequireRigidArray(session, calibration.seed.screening));
    TELESTRAIN_RETURN_IF_ERROR(RequireStatedTravels(session, data, calibration.seed.poses));
    TELESTRAIN_RETURN_IF_ERROR(RequireDifferentPoses(calibration.seed.poses));
    const ArrayState seed = StateFromSeed(session, calibration.seed);
    TELESTRAIN_ASSIGN_OR_RETURN(
        const ArrayState state,
        Explain(session, data, seed.poses, SolveRobustly(session, data, seed, options)));
    if (RemoveOutliers(session, state, options.outliers, data) == 0) return state;
    TELESTRAIN_RETURN_IF_ERROR(RequireEnoughPoses(data));
    if (round == kOutlierRounds)
      return EstimationFailed("after " + std::to_string(kOutlierRounds) +
                              " rounds of removing outliers there are still new ones; the corners "
                              "do not fit one rigid array: look at calibration images that moved "
                              "during exposure");
  }
}

// For the robust option: the corners that were removed come back, except those of images that are
// gone altogether.
void BringBackOutliers(const CalibrationData& before, CalibrationData& data) {
  std::map<std::string, int> index;
  for (std::size_t k = 0; k < data.images.size(); ++k)
    index[data.images[k].image] = static_cast<int>(k);
  data.boards.clear();
  for (const BoardData& board : before.boards) {
    const auto at = index.find(before.images[static_cast<std::size_t>(board.image)].image);
    if (at == index.end()) continue;
    data.boards.push_back(board);
    data.boards.back().image = at->second;
  }
  // Those of `before` stand first and stay.
  std::vector<RejectedObservation> rejected = before.rejected;
  for (std::size_t i = rejected.size(); i < data.rejected.size(); ++i)
    if (!index.contains(data.rejected[i].image)) rejected.push_back(data.rejected[i]);
  data.rejected = std::move(rejected);
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
  const double robust_sigmas = calibration.bundle_options.robust_sigmas;
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
      calibration.corners_below_half_weight +=
          RobustWeight((w * errors.col(i)).squaredNorm(), robust_sigmas) < 0.5;
      variance_sum_px2 += (w.transpose() * w).inverse().trace() / 2 - floor_px2;
    }
    calibration.of_board.push_back(of_board.Statistics());
  }
  calibration.all = all.Statistics();
  for (const ErrorSums& sums : of_view) calibration.of_view.push_back(sums.Statistics());
  const BundleResult& bundle = calibration.bundle;
  const double freedom = 1.0 - static_cast<double>(bundle.parameter_count) / bundle.residual_count;
  calibration.expected_rms_px = std::sqrt(std::max(0.0, variance_sum_px2) / all.corners * freedom);
  calibration.sigma0 = bundle.Sigma0();
}

// Parameters of lens and views whose uncertainty is larger than what the seed knows anyway.
std::string UselessParameters(const ArrayCalibration& array) {
  std::string useless;
  const std::vector<std::string> names = array.ParameterNames();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const double sigma = std::sqrt(array.covariance_of_noise(at, at));
    const std::string own_name = names[i].substr(names[i].rfind('.') + 1);  // without the view's
    const auto has = [&](const char* part) { return own_name.starts_with(part); };
    const double limit = has("magnification") ? kUselessScale * array.Magnification_px_per_mm()
                         : has("rotation")    ? kUselessTurn_rad
                         : has("offset")      ? kUselessOffset_mm
                                              : INFINITY;
    if (!(sigma < limit)) useless += (useless.empty() ? "" : ", ") + names[i];
  }
  return useless;
}

// Multiplies every corner's stated noise.
void ScaleNoise(double factor, CalibrationData& data) {
  data.floor_px *= factor;
  for (BoardData& board : data.boards)
    for (Eigen::Matrix2d& whitening : board.whitening) whitening /= factor;
}

Result<BundleResult> SolveWithCovariance(const Session& session, const ArrayState& start,
                                         const Calibration& calibration) {
  BundleOptions options = calibration.bundle_options;
  options.want_covariance = true;
  TELESTRAIN_ASSIGN_OR_RETURN(BundleResult solved,
                              Explain(session, calibration.data, start.poses,
                                      AdjustBundle(calibration.data, start, options)));
  const std::string useless = UselessParameters(solved.state.array);
  if (useless.empty()) return solved;
  return EstimationFailed(ExplainWeakInput(
      session, calibration.data, solved.state.poses,
      "the images do not determine the calibration: left open are " + useless +
          "; add poses with different tilts and places, with the boards spread over every view"));
}

}  // namespace

Result<Calibration> Calibrate(const Session& session,
                              const std::vector<BoardObservation>& observations,
                              const CalibrationOptions& options) {
  Calibration calibration;
  calibration.options = options;
  TELESTRAIN_ASSIGN_OR_RETURN(calibration.data, CollectCalibrationData(session, observations));
  CullRegions(session, options.culled, calibration.data);
  DropCopiedImages(session, calibration.data);
  TELESTRAIN_RETURN_IF_ERROR(RequireEnoughPoses(calibration.data));
  CalibrationData all = calibration.data;
  TELESTRAIN_ASSIGN_OR_RETURN(const ArrayState clean,
                              SolveWithoutOutliers(session, options, calibration));
  if (options.noise_is_assumed) {
    constexpr double kLeastFactor = 1e-6;  // of exact corners
    const double factor = std::max(kLeastFactor, RobustSigma(calibration.data, clean));
    ScaleNoise(factor, calibration.data);
    ScaleNoise(factor, all);
  }
  TELESTRAIN_ASSIGN_OR_RETURN(
      ChosenModel chosen, Explain(session, calibration.data, clean.poses,
                                  ChooseModel(calibration.data, clean, OptionsFor(session, options),
                                              options.model_choice)));
  if (options.robust) {
    BringBackOutliers(all, calibration.data);
    chosen.options.robust_sigmas = kRobustSigmas * std::max(1.0, chosen.bundle.Sigma0());
  }
  calibration.model_tests = std::move(chosen.tests);
  calibration.bundle_options = chosen.options;
  AlignToNominal(session, chosen.bundle.state);
  TELESTRAIN_ASSIGN_OR_RETURN(calibration.bundle,
                              SolveWithCovariance(session, chosen.bundle.state, calibration));
  CollectStatistics(session, calibration);
  for (const RejectedObservation& rejected : calibration.data.rejected)
    calibration.corners_rejected += rejected.corners;
  calibration.stage = StudyStage(session, calibration.data, calibration.bundle);
  TELESTRAIN_ASSIGN_OR_RETURN(
      calibration.cross_validation,
      CrossValidate(calibration.data, calibration.bundle.state, calibration.bundle_options));
  return calibration;
}

}  // namespace telestrain
