#include "diagnostics/mrcal_problem.h"

// Declares its structures only; mrcal's functions take a null pointer for it here.
extern "C" {
#include <mrcal/mrcal.h>
}

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "base/check.h"
#include "geometry/rotation.h"

namespace telestrain {
namespace {

constexpr std::size_t kCoreSize = 4, kDistortionSize = 5;

mrcal_pose_t PoseOfMrcal(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& origin) {
  const Eigen::Vector3d w = LogRotation(rotation);
  mrcal_pose_t pose{};
  for (int i = 0; i < 3; ++i) {
    pose.r.xyz[i] = w(i);
    pose.t.xyz[i] = origin(i);
  }
  return pose;
}

Eigen::Vector3d VectorOf(const mrcal_point3_t& point) { return {point.x, point.y, point.z}; }

// The problem as mrcal's arrays; its C frames see no exception of ours.
class Arrays {
 public:
  explicit Arrays(const MrcalProblem& problem);

  bool Evaluate();
  bool Optimise();
  void WriteBack(MrcalProblem& problem) const;
  const std::vector<double>& residuals() const { return residuals_; }

 private:
  void AddCamera(const MrcalProblem& problem, const MrcalCamera& camera);
  void AddSighting(const MrcalSighting& sighting);
  void AddPin(const MrcalPin& pin, double unit_mm);
  std::size_t IntrinsicsSize() const;
  int LensCount() const { return static_cast<int>(intrinsics_.size() / IntrinsicsSize()); }
  int PinCount() const { return static_cast<int>(pins_.size()); }
  int CameraCount() const { return static_cast<int>(cameras_.size()); }
  int FrameCount() const { return static_cast<int>(frames_.size()); }
  int SightingCount() const { return static_cast<int>(sightings_.size()); }

  mrcal_lensmodel_t model_{};
  mrcal_problem_selections_t selections_{};
  mrcal_problem_constants_t constants_{};
  mrcal_calobject_warp_t warp_{};
  double spacing_ = 0;
  int columns_ = 0, rows_ = 0;
  std::vector<double> intrinsics_, residuals_, state_;
  std::vector<mrcal_pose_t> cameras_, frames_;
  std::vector<mrcal_observation_board_t> sightings_;
  std::vector<mrcal_point3_t> nodes_, points_;
  std::vector<mrcal_observation_point_t> pins_;
  std::vector<int> sensors_;
};

bool HasDistortion(const MrcalProblem& problem) {
  for (const MrcalCamera& camera : problem.cameras)
    for (const double coefficient : camera.distortion)
      if (coefficient != 0) return true;
  return problem.free_distortion;
}

Arrays::Arrays(const MrcalProblem& problem)
    : spacing_(problem.spacing_mm / problem.unit_mm),
      columns_(problem.columns),
      rows_(problem.rows) {
  const char* model = HasDistortion(problem) ? "LENSMODEL_OPENCV5" : "LENSMODEL_PINHOLE";
  TELESTRAIN_CHECK(mrcal_lensmodel_from_name(&model_, model), "mrcal knows its own models");
  selections_.do_optimize_intrinsics_distortions = problem.free_distortion;
  selections_.do_optimize_extrinsics = selections_.do_optimize_frames = true;
  constants_.point_max_range = std::numeric_limits<double>::max();
  warp_.x2 = problem.bow_x_mm / problem.unit_mm;
  warp_.y2 = problem.bow_y_mm / problem.unit_mm;
  for (const MrcalCamera& camera : problem.cameras) AddCamera(problem, camera);
  for (const TargetPose& frame : problem.frames)
    frames_.push_back(
        PoseOfMrcal(frame.array_from_target, frame.origin_in_array_mm / problem.unit_mm));
  for (const MrcalSighting& sighting : problem.sightings) AddSighting(sighting);
  for (const MrcalPin& pin : problem.pins) AddPin(pin, problem.unit_mm);
  residuals_.resize(static_cast<std::size_t>(mrcal_num_measurements(
      SightingCount(), PinCount(), columns_, rows_, LensCount(), CameraCount(), FrameCount(),
      PinCount(), PinCount(), selections_, &model_)));
  state_.resize(static_cast<std::size_t>(mrcal_num_states(LensCount(), CameraCount(), FrameCount(),
                                                          PinCount(), PinCount(), SightingCount(),
                                                          selections_, &model_)));
}

std::size_t Arrays::IntrinsicsSize() const {
  return static_cast<std::size_t>(mrcal_lensmodel_num_params(&model_));
}

void Arrays::AddCamera(const MrcalProblem& problem, const MrcalCamera& camera) {
  intrinsics_.insert(intrinsics_.end(), {camera.focal_px.x(), camera.focal_px.y(),
                                         camera.principal_px.x(), camera.principal_px.y()});
  if (IntrinsicsSize() > kCoreSize)
    intrinsics_.insert(intrinsics_.end(), camera.distortion.begin(), camera.distortion.end());
  cameras_.push_back(
      PoseOfMrcal(camera.camera_from_reference, camera.origin_in_camera_mm / problem.unit_mm));
  // Only the regularisation, which is off, asks for the sensor's size.
  sensors_.insert(sensors_.end(), {1, 1});
}

void Arrays::AddSighting(const MrcalSighting& sighting) {
  mrcal_observation_board_t seen{};
  seen.icam.intrinsics = seen.icam.extrinsics = sighting.camera;
  seen.iframe = sighting.frame;
  sightings_.push_back(seen);
  for (Eigen::Index i = 0; i < columns_ * rows_; ++i) {
    mrcal_point3_t node{};
    node.x = sighting.pixels(0, i);
    node.y = sighting.pixels(1, i);
    node.z = sighting.weight_1_px(i) > 0 ? sighting.weight_1_px(i) : -1;
    nodes_.push_back(node);
  }
}

// A lens of its own, blind in the coordinate that is not pinned.
void Arrays::AddPin(const MrcalPin& pin, double unit_mm) {
  const std::size_t lens = IntrinsicsSize() * static_cast<std::size_t>(pin.camera);
  const std::vector<double> core(intrinsics_.begin() + lens,
                                 intrinsics_.begin() + lens + kCoreSize);
  mrcal_observation_point_t seen{};
  seen.icam.intrinsics = LensCount();
  seen.icam.extrinsics = pin.camera;
  seen.i_point = PinCount();
  seen.px.x = core[2];
  seen.px.y = core[3];
  seen.px.z = 1;
  intrinsics_.insert(intrinsics_.end(),
                     {pin.pins_u ? core[0] : 0, pin.pins_v ? core[1] : 0, core[2], core[3]});
  intrinsics_.resize(intrinsics_.size() + IntrinsicsSize() - kCoreSize);
  sensors_.insert(sensors_.end(), {1, 1});
  mrcal_point3_t point{};
  for (int i = 0; i < 3; ++i) point.xyz[i] = pin.point_in_reference_mm(i) / unit_mm;
  points_.push_back(point);
  pins_.push_back(seen);
}

bool Arrays::Evaluate() {
  return mrcal_optimizer_callback(
      state_.data(), static_cast<int>(state_.size() * sizeof(double)), residuals_.data(),
      static_cast<int>(residuals_.size() * sizeof(double)), nullptr, intrinsics_.data(),
      cameras_.data(), frames_.data(), points_.data(), &warp_, LensCount(), CameraCount(),
      FrameCount(), PinCount(), PinCount(), sightings_.data(), pins_.data(), SightingCount(),
      PinCount(), nodes_.data(), &model_, sensors_.data(), selections_, &constants_, spacing_,
      columns_, rows_, false);
}

bool Arrays::Optimise() {
  const mrcal_stats_t stats = mrcal_optimize(
      state_.data(), static_cast<int>(state_.size() * sizeof(double)), residuals_.data(),
      static_cast<int>(residuals_.size() * sizeof(double)), intrinsics_.data(), cameras_.data(),
      frames_.data(), points_.data(), &warp_, LensCount(), CameraCount(), FrameCount(), PinCount(),
      PinCount(), sightings_.data(), pins_.data(), SightingCount(), PinCount(), nodes_.data(),
      &model_, sensors_.data(), selections_, &constants_, spacing_, columns_, rows_, false, false);
  return stats.rms_reproj_error__pixels >= 0;  // -1 when it failed
}

void Arrays::WriteBack(MrcalProblem& problem) const {
  for (std::size_t c = 0; c < cameras_.size(); ++c) {
    MrcalCamera& camera = problem.cameras[c];
    camera.camera_from_reference = ExpRotation(VectorOf(cameras_[c].r));
    camera.origin_in_camera_mm = problem.unit_mm * VectorOf(cameras_[c].t);
    for (std::size_t i = 0; i < kDistortionSize && IntrinsicsSize() > kCoreSize; ++i)
      camera.distortion[i] = intrinsics_[IntrinsicsSize() * c + kCoreSize + i];
  }
  for (std::size_t k = 0; k < frames_.size(); ++k)
    problem.frames[k] = {ExpRotation(VectorOf(frames_[k].r)),
                         problem.unit_mm * VectorOf(frames_[k].t)};
}

void CheckShapes(const MrcalProblem& problem) {
  for (const MrcalSighting& sighting : problem.sightings)
    TELESTRAIN_CHECK(sighting.pixels.cols() == problem.columns * problem.rows &&
                         sighting.weight_1_px.size() == sighting.pixels.cols(),
                     "a sighting holds every node of the grid");
}

double SumOfSquares(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()))
      .squaredNorm();
}

Eigen::Index NodesSeen(const MrcalProblem& problem) {
  Eigen::Index seen = 0;
  for (const MrcalSighting& sighting : problem.sightings)
    seen += (sighting.weight_1_px.array() > 0).count();
  return seen;
}

}  // namespace

TargetPose Compose(const TargetPose& c_from_b, const TargetPose& b_from_a) {
  return {c_from_b.array_from_target * b_from_a.array_from_target,
          c_from_b.array_from_target * b_from_a.origin_in_array_mm + c_from_b.origin_in_array_mm};
}

TargetPose GridInTarget(const BoardGeometry& geometry, double scale) {
  const Eigen::Vector3d& x = geometry.x_in_target;
  const Eigen::Vector3d& y = geometry.y_in_target;
  TargetPose grid;
  grid.array_from_target << x, y, x.cross(y);
  grid.origin_in_array_mm = geometry.center_in_target_mm -
                            scale * (geometry.half_width_mm * x + geometry.half_height_mm * y);
  return grid;
}

Result<std::vector<Eigen::Matrix2Xd>> MrcalResiduals(const MrcalProblem& problem) {
  CheckShapes(problem);
  Arrays arrays(problem);
  if (!arrays.Evaluate()) return EstimationFailed("mrcal cannot evaluate the problem");
  std::vector<Eigen::Matrix2Xd> residuals;
  const double* next = arrays.residuals().data();
  for (const MrcalSighting& sighting : problem.sightings) {
    residuals.emplace_back(Eigen::Map<const Eigen::Matrix2Xd>(next, 2, sighting.pixels.cols()));
    next += 2 * sighting.pixels.cols();
  }
  return residuals;
}

// What is pinned has the value zero, which no magnification and no depth changes.
std::vector<MrcalPin> PinsAt(const std::vector<MrcalCamera>& cameras) {
  TELESTRAIN_CHECK(cameras.size() >= 2, "the depth of a camera is pinned by another one");
  constexpr double kReach_mm = 10;  // about a field
  const MrcalCamera& first = cameras.front();
  const Eigen::Matrix3d axes = first.camera_from_reference.transpose();
  const Eigen::Vector3d depth = axes.col(2);
  const Eigen::Vector3d middle = -axes.leftCols<2>() * first.origin_in_camera_mm.head<2>();
  MrcalPin last;
  double steepest = 0;
  for (std::size_t c = 1; c < cameras.size(); ++c) {
    for (const int row : {0, 1}) {
      const Eigen::RowVector3d along = cameras[c].camera_from_reference.row(row);
      const double slope = along.dot(depth);
      if (std::abs(slope) <= std::abs(steepest)) continue;
      steepest = slope;
      const double value = along.dot(middle) + cameras[c].origin_in_camera_mm(row);
      last = {static_cast<int>(c), middle - value / slope * depth, row == 0, row == 1};
    }
  }
  return {{0, middle, true, true},
          {0, middle + kReach_mm * depth, true, true},
          {0, middle + kReach_mm * axes.col(0), false, true},
          last};
}

Result<MrcalOutcome> SolveWithMrcal(MrcalProblem& problem) {
  CheckShapes(problem);
  constexpr int kMaxRuns = 8;
  // Of the sum of squares: rounding of a sum of some ten thousand terms.
  constexpr double kStays = 1e-12;
  constexpr double kNothing = 1e-16;  // of one scalar: 1e-8 px of a corner without noise
  const auto scalars = static_cast<double>(2 * NodesSeen(problem));
  Arrays arrays(problem);
  if (!arrays.Evaluate()) return EstimationFailed("mrcal cannot evaluate the problem");
  double before = SumOfSquares(arrays.residuals());
  MrcalOutcome outcome;
  while (!outcome.converged && outcome.runs < kMaxRuns) {
    if (!arrays.Optimise()) return EstimationFailed("mrcal's optimisation failed");
    const double after = SumOfSquares(arrays.residuals());
    outcome.converged = std::abs(before - after) <= kStays * before + kNothing * scalars;
    before = after;
    ++outcome.runs;
  }
  outcome.rms = std::sqrt(before / scalars);
  arrays.WriteBack(problem);
  return outcome;
}

}  // namespace telestrain
