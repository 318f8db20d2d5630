// Speed of the bundle adjustment on one core, against mrcal_optimize on the pinhole twin of the
// same problem: four views, 117 corners a board, noise 0.1 px, a seed about 1 px off.
#include <benchmark/benchmark.h>
extern "C" {
#include <mrcal/mrcal.h>
}

#include <algorithm>
#include <cmath>
#include <ctime>

#include "calibration/bundle_covariance.h"
#include "geometry/rotation.h"
#include "tests/unit/calibration/synthetic_array.h"

namespace telestrain {
namespace {

using testing_support::Random;

struct Problem {
  CalibrationData data;
  ArrayState truth, start;
};

// Every image is a pose of its own, so that the twin has the same unknowns.
Problem MakeProblem(int images) {
  testing_support::SyntheticOptions options;
  options.poses = images / 2;
  testing_support::SyntheticArray array = MakeSyntheticArray(options);
  for (CalibrationImage& image : array.session.calibration_images) {
    image.pose = image.image;
    image.stage_mm = 0;
  }
  array.session.target.sigma_square_um = 0.05;
  array.session.target.sigma_separation_um = 0.25;
  array.session.target.coplanarity_um = 0.5;
  Problem problem;
  problem.data = CollectCalibrationData(array.session, array.boards).value();
  problem.truth.array.lenses = {array.lens};
  problem.truth.array.views = array.views;
  problem.truth.poses = array.poses;
  problem.start = problem.truth;
  Random random(9);
  problem.start.array.lenses.front().magnification_px_per_mm *= 1.001;
  for (TelecentricView& view : problem.start.array.views) {
    const Eigen::Vector3d turn(random.Normal(1e-3), random.Normal(1e-3), random.Normal(1e-3));
    view.axes_in_array = (ExpRotation(turn) * view.Rotation()).topRows<2>();
  }
  for (std::size_t k = 1; k < problem.start.poses.size(); ++k) {
    TargetPose& pose = problem.start.poses[k];
    const auto draw = [&](double sigma) {
      return Eigen::Vector3d(random.Normal(sigma), random.Normal(sigma), random.Normal(sigma));
    };
    pose.array_from_target = (ExpRotation(draw(3e-4)) * pose.array_from_target).eval();
    pose.origin_in_array_mm += draw(0.004);
  }
  return problem;
}

double Rms_px(const Problem& problem, const ArrayState& state) {
  double sum = 0;
  for (const BoardData& board : problem.data.boards)
    sum += ReprojectionErrors_px(state, board).squaredNorm();
  return std::sqrt(sum / static_cast<double>(2 * problem.data.CornerCount()));
}

double CpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double TimeOfAdjustment_s(const Problem& problem, const BundleOptions& options,
                          BundleResult& result) {
  const double begin = CpuSeconds();
  result = AdjustBundle(problem.data, problem.start, options).value();
  return CpuSeconds() - begin;
}

void Adjust(benchmark::State& state, bool want_covariance, const LensModel& model) {
  const Problem problem = MakeProblem(static_cast<int>(state.range(0)));
  BundleOptions options;
  options.model = model;
  options.want_covariance = want_covariance;
  BundleResult result;
  for (auto _ : state) TimeOfAdjustment_s(problem, options, result);
  state.counters["seed_px"] = Rms_px(problem, problem.start);
  state.counters["rms_px"] = Rms_px(problem, result.state);
  state.counters["iterations"] = result.iterations;
  state.SetLabel(result.termination);
}
const LensModel kFullModel{{true, true, true, true, true}, true, true, false};

void AdjustPlain(benchmark::State& state) { Adjust(state, false, {}); }
void AdjustWithCovariance(benchmark::State& state) { Adjust(state, true, {}); }
void AdjustFullModel(benchmark::State& state) { Adjust(state, false, kFullModel); }
void AdjustFullModelWithCovariance(benchmark::State& state) { Adjust(state, true, kFullModel); }
BENCHMARK(AdjustPlain)->Arg(18)->Arg(300)->Arg(1200)->Unit(benchmark::kMillisecond);
BENCHMARK(AdjustWithCovariance)->Arg(18)->Arg(300)->Arg(1200)->Unit(benchmark::kMillisecond);
BENCHMARK(AdjustFullModel)->Arg(300)->Unit(benchmark::kMillisecond);
BENCHMARK(AdjustFullModelWithCovariance)->Arg(300)->Unit(benchmark::kMillisecond);

void Collect(benchmark::State& state) {
  testing_support::SyntheticOptions options;
  options.poses = 150;
  const auto array = MakeSyntheticArray(options);
  for (auto _ : state)
    benchmark::DoNotOptimize(CollectCalibrationData(array.session, array.boards));
}
BENCHMARK(Collect)->Unit(benchmark::kMillisecond);

void Reproject(benchmark::State& state) {
  const Problem problem = MakeProblem(300);
  for (auto _ : state) benchmark::DoNotOptimize(Rms_px(problem, problem.start));
}
BENCHMARK(Reproject)->Unit(benchmark::kMillisecond);

void CalibrateFrames(benchmark::State& state) {
  testing_support::SyntheticOptions options;
  options.poses = 150;
  const auto array = MakeSyntheticArray(options);
  for (auto _ : state) benchmark::DoNotOptimize(Calibrate(array.session, array.boards).ok());
}
BENCHMARK(CalibrateFrames)->Unit(benchmark::kMillisecond);

// Lengths in km, and pinholes so far away that their rays are parallel: mrcal's telecentric limit.
// Their cores stay fixed; the distance takes the magnification's place.
struct MrcalTwin {
  static constexpr double kDistance_mm = 1e12, kKm = 1e-6;
  std::vector<double> cores;
  std::vector<mrcal_pose_t> cameras, frames;
  std::vector<mrcal_observation_board_t> boards;
  std::vector<mrcal_point3_t> pixels;
  std::vector<int> sensor;
  double square_mm = 0, rms_px = 0;

  explicit MrcalTwin(const Problem& problem);
  double Optimise_s();
};

mrcal_pose_t PoseOf(const Eigen::Vector3d& w, const Eigen::Vector3d& t) {
  mrcal_pose_t pose{};
  for (int i = 0; i < 3; ++i) {
    pose.r.xyz[i] = w(i);
    pose.t.xyz[i] = t(i) * MrcalTwin::kKm;
  }
  return pose;
}

// The views of one group see board A, those of the other board B; a grid of mrcal has one board,
// so each view's offset takes in where the board of its group lies in the target.
MrcalTwin::MrcalTwin(const Problem& problem) : square_mm(problem.data.target.square_mm) {
  const TargetSpec& target = problem.data.target;
  const TelecentricLens& lens = problem.start.array.lenses.front();
  const double focal_px = lens.magnification_px_per_mm * kDistance_mm;
  for (const TelecentricView& view : problem.start.array.views) {
    cores.insert(cores.end(), {focal_px, focal_px, lens.center_px.x(), lens.center_px.y()});
    const Eigen::Vector3d middle = target.FindBoard(view.group)->center_in_target_mm;
    const Eigen::Vector2d offset = view.offset_mm + view.axes_in_array * middle;
    cameras.push_back(PoseOf(LogRotation(view.Rotation()), {offset.x(), offset.y(), kDistance_mm}));
    sensor.insert(sensor.end(), {2592, 1944});
  }
  const Eigen::Vector3d to_first_corner(-0.5 * target.square_mm * (target.columns - 1),
                                        -0.5 * target.square_mm * (target.rows - 1), 0);
  for (const TargetPose& pose : problem.start.poses)
    frames.push_back(PoseOf(LogRotation(pose.array_from_target),
                            pose.origin_in_array_mm + pose.array_from_target * to_first_corner));
  for (const BoardData& board : problem.data.boards) {
    const TargetPose& pose = problem.truth.poses[static_cast<std::size_t>(board.image)];
    const TelecentricView& view = problem.truth.array.views[static_cast<std::size_t>(board.view)];
    // What the true pose's rotation makes of the board's distance is taken off the pixels.
    const Eigen::Vector3d middle = target.FindBoard(view.group)->center_in_target_mm;
    const Eigen::Vector2d turned_px =
        problem.truth.array.lenses.front().magnification_px_per_mm *
        (view.axes_in_array * (pose.array_from_target * middle - middle));
    mrcal_observation_board_t seen{};
    seen.icam.intrinsics = seen.icam.extrinsics = board.view;
    seen.iframe = board.image;
    boards.push_back(seen);
    for (Eigen::Index i = 0; i < board.Count(); ++i) {
      mrcal_point3_t pixel{};
      pixel.x = board.pixels(0, i) - turned_px.x();
      pixel.y = board.pixels(1, i) - turned_px.y();
      pixel.z = 1;
      pixels.push_back(pixel);
    }
  }
}

double MrcalTwin::Optimise_s() {
  mrcal_lensmodel_t model;
  mrcal_lensmodel_from_name(&model, "LENSMODEL_PINHOLE");
  mrcal_problem_selections_t selections{};
  selections.do_optimize_extrinsics = selections.do_optimize_frames = true;
  mrcal_problem_constants_t constants{};
  const auto views = static_cast<int>(cameras.size()), images = static_cast<int>(frames.size());
  const auto seen = static_cast<int>(boards.size());
  auto free_cores = cores;
  auto free_cameras = cameras;
  auto free_frames = frames;
  auto free_pixels = pixels;
  std::vector<double> residuals(static_cast<std::size_t>(
      mrcal_num_measurements(seen, 0, 13, 9, views, views, images, 0, 0, selections, &model)));
  const double begin = CpuSeconds();
  const mrcal_stats_t stats = mrcal_optimize(
      nullptr, 0, residuals.data(), static_cast<int>(residuals.size() * sizeof(double)),
      free_cores.data(), free_cameras.data(), free_frames.data(), nullptr, nullptr, views, views,
      images, 0, 0, boards.data(), nullptr, seen, 0, free_pixels.data(), &model, sensor.data(),
      selections, &constants, square_mm * kKm, 13, 9, false, false);
  rms_px = stats.rms_reproj_error__pixels;
  return CpuSeconds() - begin;
}

// Both in turn, so that a busy machine slows both: the counter is the ratio of the medians.
void AgainstMrcal(benchmark::State& state) {
  const Problem problem = MakeProblem(static_cast<int>(state.range(0)));
  MrcalTwin twin(problem);
  BundleResult result;
  std::vector<double> ours, theirs;
  for (auto _ : state) {
    ours.push_back(TimeOfAdjustment_s(problem, {}, result));
    theirs.push_back(twin.Optimise_s());
  }
  const auto median = [](std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  };
  state.counters["telestrain_ms"] = 1000 * median(ours);
  state.counters["mrcal_ms"] = 1000 * median(theirs);
  state.counters["ratio"] = median(ours) / median(theirs);
  state.counters["rms_px"] = Rms_px(problem, result.state);
  state.counters["mrcal_rms_px"] = twin.rms_px;
}
BENCHMARK(AgainstMrcal)->Arg(300)->Iterations(9)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace telestrain
