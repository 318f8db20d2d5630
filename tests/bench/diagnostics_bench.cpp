// CPU time of the residual diagnostics of 36 images, 4 views, 117 corners a board.
#include <benchmark/benchmark.h>

#include "diagnostics/residual_pattern.h"
// What `telestrain diagnose` pays for mrcal: 36 images of four views with 117 corners each.
#include <benchmark/benchmark.h>

#include "calibration/calibrate.h"
#include "diagnostics/independent_optimum.h"
#include "diagnostics/pinhole_comparison.h"
#include "tests/unit/calibration/synthetic_array.h"

namespace telestrain {
namespace {

struct Fit {
  CalibrationData data;
  ArrayState state;
};

const Fit& Fitted() {
  static const Fit fit = [] {
    testing_support::SyntheticOptions options;
    options.poses = 18;
    const auto array = testing_support::MakeSyntheticArray(options);
    Fit made;
    made.data = CollectCalibrationData(array.session, array.boards).value();
    made.state.array.lenses = {array.lens};
    made.state.array.views = array.views;
    made.state.poses = array.poses;
    made.state = AdjustBundle(made.data, made.state, {}).value().state;
    return made;
  }();
  return fit;
}

void BM_Statistics(benchmark::State& run) {
  const Fit& fit = Fitted();
  for (auto _ : run) {
    ResidualList residuals = ResidualsOf(fit.data, fit.state);
    benchmark::DoNotOptimize(Summarise(residuals));
    benchmark::DoNotOptimize(HistogramOfResiduals(residuals));
    benchmark::DoNotOptimize(BoardsFromWorst(residuals));
    benchmark::DoNotOptimize(DirectionsOf(residuals));
    for (int view = 0; view < 4; ++view)
      benchmark::DoNotOptimize(RegionalStatistics(OfView(residuals, view), {0, 0, 1296, 972}));
    benchmark::DoNotOptimize(ReplayOutlierRule(residuals));
  }
}
BENCHMARK(BM_Statistics)->Unit(benchmark::kMillisecond);

void BM_JudgeResiduals(benchmark::State& run) {
  for (auto _ : run) benchmark::DoNotOptimize(JudgeResiduals(Fitted().data, Fitted().state));
}
BENCHMARK(BM_JudgeResiduals)->Unit(benchmark::kMillisecond);
struct Problem {
  Problem() : array(MakeArray()), calibration(Calibrate(array.session, array.boards).value()) {
    testing_support::Random random(9);
    start = calibration.bundle.state;
    for (TelecentricView& view : start.array.views)
      view.offset_mm += Eigen::Vector2d(random.Normal(0.005), random.Normal(0.005));
  }
  static testing_support::SyntheticArray MakeArray() {
    testing_support::SyntheticOptions options;
    options.poses = 18;
    return MakeSyntheticArray(options);
  }
  testing_support::SyntheticArray array;
  Calibration calibration;
  ArrayState start;
};

void Check(benchmark::State& state) {
  const Problem problem;
  IndependentOptimum found;
  for (auto _ : state)
    found =
        CheckAgainstMrcal(problem.calibration.data, problem.calibration.bundle.state, problem.start)
            .value();
  state.counters["optimised_px"] = found.max_residual_difference_px;
  state.counters["evaluated_px"] = found.evaluated_max_residual_difference_px;
  state.counters["ours_s"] = found.seconds;
  state.counters["mrcal_s"] = found.mrcal_seconds;
}
BENCHMARK(Check)->Unit(benchmark::kMillisecond);

void Compare(benchmark::State& state) {
  const Problem problem;
  for (auto _ : state)
    benchmark::DoNotOptimize(ComparePinhole(problem.array.session, problem.calibration.data,
                                            problem.calibration.bundle.state, {}));
}
BENCHMARK(Compare)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

}  // namespace
}  // namespace telestrain
