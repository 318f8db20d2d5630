// What `telestrain diagnose` pays: 36 images of four views with 117 corners each.
#include <benchmark/benchmark.h>

#include "calibration/calibrate.h"
#include "diagnostics/independent_optimum.h"
#include "diagnostics/pinhole_comparison.h"
#include "diagnostics/residual_pattern.h"
#include "tests/unit/calibration/synthetic_array.h"

namespace telestrain {
namespace {

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

const Problem& OneProblem() {
  static const Problem problem;
  return problem;
}

void Statistics(benchmark::State& run) {
  const Calibration& fit = OneProblem().calibration;
  for (auto _ : run) {
    ResidualList residuals = ResidualsOf(fit.data, fit.bundle.state);
    benchmark::DoNotOptimize(Summarise(residuals));
    benchmark::DoNotOptimize(HistogramOfResiduals(residuals));
    benchmark::DoNotOptimize(BoardsFromWorst(residuals));
    benchmark::DoNotOptimize(DirectionsOf(residuals));
    for (int view = 0; view < 4; ++view)
      benchmark::DoNotOptimize(RegionalStatistics(OfView(residuals, view), {0, 0, 1296, 972}));
    benchmark::DoNotOptimize(ReplayOutlierRule(residuals));
  }
}
BENCHMARK(Statistics)->Unit(benchmark::kMillisecond);

void Judge(benchmark::State& run) {
  const Calibration& fit = OneProblem().calibration;
  for (auto _ : run) benchmark::DoNotOptimize(JudgeResiduals(fit.data, fit.bundle.state));
}
BENCHMARK(Judge)->Unit(benchmark::kMillisecond);

void Check(benchmark::State& state) {
  const Problem& problem = OneProblem();
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
  const Problem& problem = OneProblem();
  for (auto _ : state)
    benchmark::DoNotOptimize(ComparePinhole(problem.array.session, problem.calibration.data,
                                            problem.calibration.bundle.state, {}));
}
BENCHMARK(Compare)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

}  // namespace
}  // namespace telestrain
