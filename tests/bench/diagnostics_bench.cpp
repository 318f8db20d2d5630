// CPU time of the residual diagnostics of 36 images, 4 views, 117 corners a board.
#include <benchmark/benchmark.h>

#include "diagnostics/residual_pattern.h"
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

}  // namespace
}  // namespace telestrain
