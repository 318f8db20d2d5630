#include "calibration/array_seed.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

#include "base/numbers.h"
#include "calibration/planar_view.h"
#include "geometry/rotation.h"

namespace telestrain {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kMinBoardsPerView = 2;
constexpr int kAveragingRounds = 20;

// One board with what its homography says.
struct SeedBoard {
  const BoardData* data = nullptr;
  AffineHomography homography;
  TwoFoldRotation rotations;
  int branch = 0;

  const Eigen::Matrix3d& CameraFromTarget() const {
    return rotations.camera_from_target[static_cast<std::size_t>(branch)];
  }
};

Result<std::vector<SeedBoard>> FitHomographies(const CalibrationData& data) {
  std::vector<SeedBoard> boards;
  for (const BoardData& board : data.boards) {
    SeedBoard seed{&board, {}, {}, 0};
    auto homography = FitAffineHomography(board.corners_in_target_mm.topRows<2>(), board.pixels);
    if (!homography)
      return EstimationFailed(data.images[static_cast<std::size_t>(board.image)].image + ": " +
                              homography.error().message);
    seed.homography = *homography;
    boards.push_back(std::move(seed));
  }
  return boards;
}

int BoardsIn(const std::vector<SeedBoard>& boards, std::size_t view) {
  return static_cast<int>(std::count_if(boards.begin(), boards.end(), [&](const SeedBoard& b) {
    return b.data->view == static_cast<int>(view);
  }));
}

// A group that sees nothing is a board that was covered or never there, not a matter of numbers.
Status RequireEveryGroup(const Session& session, const std::vector<SeedBoard>& boards) {
  for (const std::string& group : session.Groups()) {
    int count = 0;
    for (std::size_t view = 0; view < session.views.size(); ++view)
      if (session.views[view].group == group) count += BoardsIn(boards, view);
    if (count == 0)
      return EstimationFailed(
          "no image shows the target's board of group '" + group +
          "' to two of its views: without it nothing ties this group to the others; see the "
          "reasons in detection.json, and take images with both boards of the plate in the fields");
  }
  return {};
}

Status RequireEnoughBoards(const Session& session, const std::vector<SeedBoard>& boards) {
  TELESTRAIN_RETURN_IF_ERROR(RequireEveryGroup(session, boards));
  for (std::size_t view = 0; view < session.views.size(); ++view) {
    const int count = BoardsIn(boards, view);
    if (count < kMinBoardsPerView)
      return EstimationFailed("view '" + session.views[view].name + "' sees the target in " +
                              std::to_string(count) + " usable images, at least " +
                              std::to_string(kMinBoardsPerView) +
                              " are needed; see the rejected boards in detection.json and take "
                              "more images with the board inside this view");
  }
  return {};
}

void SeedMagnifications(const Session& session, const std::vector<SeedBoard>& boards,
                        ArraySeed& seed) {
  std::vector<double> all;
  for (std::size_t view = 0; view < session.views.size(); ++view) {
    std::vector<double> of_view;
    std::vector<AffineHomography> homographies;
    for (const SeedBoard& board : boards) {
      if (board.data->view != static_cast<int>(view)) continue;
      of_view.push_back(MagnificationFromHomography(board.homography));
      homographies.push_back(board.homography);
    }
    all.insert(all.end(), of_view.begin(), of_view.end());
    seed.view_magnification_px_per_mm.push_back(Median(of_view));
    seed.view_magnifications_of_paper.push_back(TwoMagnificationsOfPaper(homographies));
  }
  seed.lens = session.NominalLens();
  seed.lens.magnification_px_per_mm = Median(all);
}

// Orientation of the target in the array if the view were as designed.
Eigen::Matrix3d ArrayFromTarget(const Session& session, const SeedBoard& board, int branch) {
  const auto& view = session.views[static_cast<std::size_t>(board.data->view)];
  return session.NominalTelecentricView(view).Rotation().transpose() *
         board.rotations.camera_from_target[static_cast<std::size_t>(branch)];
}

// How badly the branches in the bits of `choice` fit together: the spread of the orientations that
// the views give, rad^2, plus a little of the target's own tilt, which decides where the views
// that see it all look along one direction.
double Disagreement(const Session& session, const std::vector<SeedBoard*>& boards,
                    unsigned choice) {
  constexpr double kTiltWeight = 1e-3;
  std::vector<Eigen::Matrix3d> orientations;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < boards.size(); ++i) {
    orientations.push_back(ArrayFromTarget(session, *boards[i], (choice >> i) & 1u));
    sum += orientations.back();
  }
  const Eigen::Matrix3d mean = NearestRotation(sum);
  double disagreement = 0;
  for (const Eigen::Matrix3d& orientation : orientations) {
    const double spread_rad = AngleBetween_rad(orientation, mean);
    const double tilt_rad = std::acos(std::clamp(orientation(2, 2), -1.0, 1.0));
    disagreement += spread_rad * spread_rad + kTiltWeight * tilt_rad * tilt_rad;
  }
  return disagreement / static_cast<double>(orientations.size());
}

// Decides the branches of all boards of one image together: the views must see one target.
void DecideImage(const Session& session, const std::vector<SeedBoard*>& boards,
                 AmbiguityDecision& decision) {
  double best = 1e9, second = 1e9;
  unsigned choice = 0;
  for (unsigned c = 0; c < (1u << boards.size()); ++c) {
    const double disagreement = Disagreement(session, boards, c);
    if (disagreement < best) {
      second = best;
      best = disagreement;
      choice = c;
    } else {
      second = std::min(second, disagreement);
    }
  }
  for (std::size_t i = 0; i < boards.size(); ++i)
    boards[i]->branch = static_cast<int>((choice >> i) & 1u);
  decision.smallest_nominal_margin_deg = std::min(
      decision.smallest_nominal_margin_deg, (std::sqrt(second) - std::sqrt(best)) * 180.0 / kPi);
}

void DecideByGeometry(const Session& session, std::vector<SeedBoard>& boards,
                      AmbiguityDecision& decision) {
  decision.boards = static_cast<int>(boards.size());
  decision.smallest_nominal_margin_deg = 180;
  std::map<int, std::vector<SeedBoard*>> of_image;
  for (SeedBoard& board : boards) of_image[board.data->image].push_back(&board);
  for (const auto& [image, members] : of_image) DecideImage(session, members, decision);
}

// The stage moves the target along a known sense of its normal; the corners then move along
// (r13, r23) of the true branch (the paper's Eq. 9, MODEL.md Eq. 9).
void CheckByStage(const Session& session, const CalibrationData& data,
                  const std::vector<SeedBoard>& boards, AmbiguityDecision& decision) {
  const double sense = session.stage_axis_in_array.z() >= 0 ? 1.0 : -1.0;
  std::map<std::pair<std::string, int>, const SeedBoard*> first_of_pose;
  decision.smallest_stage_margin_px = 1e9;
  for (const SeedBoard& board : boards) {
    const CalibrationImage& image = data.images[static_cast<std::size_t>(board.data->image)];
    const auto [at, is_first] = first_of_pose.try_emplace({image.pose, board.data->view}, &board);
    if (is_first) continue;
    const double travel_mm =
        image.stage_mm - data.images[static_cast<std::size_t>(at->second->data->image)].stage_mm;
    if (travel_mm == 0) continue;
    const Eigen::Vector2d center_mm =
        board.data->corners_in_target_mm.topRows<2>().rowwise().mean();
    const auto pixel_of_center = [&](const AffineHomography& h) -> Eigen::Vector2d {
      return h.px_per_mm * center_mm + h.offset_px;
    };
    const Eigen::Vector2d moved_px =
        pixel_of_center(board.homography) - pixel_of_center(at->second->homography);
    const Eigen::Vector2d depth_row = board.CameraFromTarget().block<2, 1>(0, 2);
    if (depth_row.norm() < 0.0175) continue;  // below 1 degree of tilt the move decides nothing
    const double along_px =
        sense * travel_mm / std::abs(travel_mm) * moved_px.dot(depth_row.normalized());
    ++decision.stage_pairs;
    if (along_px > 0) ++decision.stage_agreeing;
    decision.smallest_stage_margin_px =
        std::min(decision.smallest_stage_margin_px, std::abs(along_px));
  }
  if (decision.stage_pairs == 0) decision.smallest_stage_margin_px = 0;
}

Status RequireDecision(const AmbiguityDecision& decision) {
  if (5 * decision.stage_agreeing >= 4 * decision.stage_pairs) return {};
  return EstimationFailed(
      "the stage moves contradict the nominal views: only " +
      std::to_string(decision.stage_agreeing) + " of " + std::to_string(decision.stage_pairs) +
      " boards moved to the side that [stage] axis_in_array and the [[view]] vectors of "
      "session.toml predict; one of the two has the wrong sign: check the sense of positive "
      "stage_mm");
}

// Alternates between the poses given the views and the views given the poses, from the nominal
// views; each is the rotation nearest to the mean.
void AverageRotations(const std::vector<SeedBoard>& boards, ArraySeed& seed) {
  std::vector<Eigen::Matrix3d> views;
  for (const TelecentricView& view : seed.views) views.push_back(view.Rotation());
  for (int round = 0; round < kAveragingRounds; ++round) {
    std::vector<Eigen::Matrix3d> poses(seed.poses.size(), Eigen::Matrix3d::Zero());
    for (const SeedBoard& b : boards)
      poses[static_cast<std::size_t>(b.data->image)] +=
          views[static_cast<std::size_t>(b.data->view)].transpose() * b.CameraFromTarget();
    for (Eigen::Matrix3d& pose : poses) pose = NearestRotation(pose);
    std::vector<Eigen::Matrix3d> sums(views.size(), Eigen::Matrix3d::Zero());
    for (const SeedBoard& b : boards)
      sums[static_cast<std::size_t>(b.data->view)] +=
          b.CameraFromTarget() * poses[static_cast<std::size_t>(b.data->image)].transpose();
    for (std::size_t i = 0; i < views.size(); ++i) views[i] = NearestRotation(sums[i]);
    for (std::size_t k = 0; k < poses.size(); ++k) seed.poses[k].array_from_target = poses[k];
  }
  for (std::size_t i = 0; i < views.size(); ++i)
    seed.views[i].axes_in_array = views[i].topRows<2>();
}

// Linear least squares for all offsets and origins: A_i T_k + t_i = y_ik, where y_ik is the
// measured board centre minus its rotated target position. The origins are eliminated one by one; a
// weak pull of the offsets to their nominal values holds the gauge (MODEL.md Eq. 10).
void SolveTranslations(const std::vector<SeedBoard>& boards, ArraySeed& seed) {
  constexpr double kGaugeWeight = 1e-6;
  const auto views = static_cast<Eigen::Index>(seed.views.size());
  Eigen::MatrixXd normal = kGaugeWeight * Eigen::MatrixXd::Identity(2 * views, 2 * views);
  Eigen::VectorXd right(2 * views);
  for (Eigen::Index i = 0; i < views; ++i)
    right.segment<2>(2 * i) = kGaugeWeight * seed.views[static_cast<std::size_t>(i)].offset_mm;

  struct PoseSystem {
    Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
    Eigen::Matrix3Xd coupling;
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
  };
  std::vector<PoseSystem> poses(seed.poses.size());
  for (PoseSystem& pose : poses) pose.coupling = Eigen::Matrix3Xd::Zero(3, 2 * views);
  for (const SeedBoard& b : boards) {
    const TelecentricView& view = seed.views[static_cast<std::size_t>(b.data->view)];
    const auto image = static_cast<std::size_t>(b.data->image);
    const Eigen::Vector3d center = b.data->corners_in_target_mm.rowwise().mean();
    const Eigen::Vector2d y = seed.lens.IdealFromPixel(b.data->pixels.rowwise().mean()) -
                              view.axes_in_array * seed.poses[image].array_from_target * center;
    const Eigen::Index at = 2 * b.data->view;
    poses[image].block += view.axes_in_array.transpose() * view.axes_in_array;
    poses[image].coupling.middleCols<2>(at) += view.axes_in_array.transpose();
    poses[image].right += view.axes_in_array.transpose() * y;
    normal.block<2, 2>(at, at) += Eigen::Matrix2d::Identity();
    right.segment<2>(at) += y;
  }
  for (const PoseSystem& pose : poses) {
    const Eigen::MatrixXd eliminated = pose.block.ldlt().solve(pose.coupling);
    normal -= pose.coupling.transpose() * eliminated;
    right -= eliminated.transpose() * pose.right;
  }
  const Eigen::VectorXd offsets = normal.ldlt().solve(right);
  for (Eigen::Index i = 0; i < views; ++i)
    seed.views[static_cast<std::size_t>(i)].offset_mm = offsets.segment<2>(2 * i);
  for (std::size_t k = 0; k < poses.size(); ++k)
    seed.poses[k].origin_in_array_mm =
        poses[k].block.ldlt().solve(poses[k].right - poses[k].coupling * offsets);
}

}  // namespace

Result<ArraySeed> SeedArray(const Session& session, const CalibrationData& data) {
  TELESTRAIN_ASSIGN_OR_RETURN(std::vector<SeedBoard> boards, FitHomographies(data));
  TELESTRAIN_RETURN_IF_ERROR(RequireEnoughBoards(session, boards));
  ArraySeed seed;
  SeedMagnifications(session, boards, seed);
  for (SeedBoard& board : boards)
    board.rotations = RotationsFromHomography(board.homography, seed.lens.magnification_px_per_mm);
  DecideByGeometry(session, boards, seed.decision);
  CheckByStage(session, data, boards, seed.decision);
  TELESTRAIN_RETURN_IF_ERROR(RequireDecision(seed.decision));
  for (const NominalView& view : session.views)
    seed.views.push_back(session.NominalTelecentricView(view));
  seed.poses.resize(data.images.size());
  std::vector<BranchedBoard> branched;
  for (const SeedBoard& b : boards)
    branched.push_back({b.data->image, b.data->view, b.rotations.camera_from_target, b.branch});
  seed.screening = ScreenBranches(branched);
  AverageRotations(boards, seed);
  SolveTranslations(boards, seed);
  return seed;
}

}  // namespace telestrain
