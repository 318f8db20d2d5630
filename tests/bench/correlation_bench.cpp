// Speed of the subset correlation on one core: points/s, ns per pixel and iteration.
#include <benchmark/benchmark.h>

#include "correlation/subset_correlation.h"
#include "tests/unit/correlation/speckle.h"

namespace telestrain {
namespace {

constexpr int kSide = 512;
const PixelRegion kRegion{0, 0, kSide, kSide};

void MatchPoints(benchmark::State& state, const ShapeFunction& map) {
  CorrelationOptions options;
  options.subset_px = static_cast<int>(state.range(0));
  const Eigen::Vector2d about = kRegion.Middle();
  const Speckle speckle(1, kSide, kSide);
  std::mt19937 random(2);
  GrayImage before = speckle.Render(kSide, kSide), after = speckle.Render(kSide, kSide, map, about);
  AddNoise(1, random, before);
  AddNoise(1, random, after);
  const CorrelationReference reference(before, kRegion, options);
  const bool other_view = map.gradient.norm() > 0.1;
  const PreparedImage image(after, kRegion, options,
                            other_view ? map.gradient : Eigen::Matrix2d::Zero().eval());
  const auto centers = GridOfCenters(kRegion, 150, 10);
  double points = 0, iterations = 0;
  for (auto _ : state) {
    for (const auto& center : centers) {
      ShapeFunction start = TruthAt(map, about, center);
      start.displacement_px += Eigen::Vector2d(0.2, -0.2);
      const SubsetMatch match = reference.Match(center, image, start);
      iterations += match.iterations;
      ++points;
      if (!match.ok()) state.SkipWithError("a point failed");
    }
  }
  const double pixels = static_cast<double>(state.range(0) * state.range(0));
  state.counters["points/s"] = benchmark::Counter(points, benchmark::Counter::kIsRate);
  state.counters["s/px/iteration"] = benchmark::Counter(
      iterations * pixels, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["iterations"] = iterations / points;
}

void SmallStrain(benchmark::State& state) {
  ShapeFunction map;
  map.displacement_px = {0.3, 0.4};
  map.gradient << 5e-4, 1e-4, -1e-4, -2e-4;
  MatchPoints(state, map);
}
BENCHMARK(SmallStrain)->Arg(33)->Arg(61)->Unit(benchmark::kMillisecond);

void StereoGradient(benchmark::State& state) {
  ShapeFunction map;
  map.displacement_px = {0.3, 0.4};
  map.gradient << -0.4, 0.1, 0.05, 0.1;
  MatchPoints(state, map);
}
BENCHMARK(StereoGradient)->Arg(33)->Arg(61)->Unit(benchmark::kMillisecond);

void Prepare(benchmark::State& state) {
  const GrayImage image = Speckle(1, 1296, 972).Render(1296, 972);
  for (auto _ : state)
    benchmark::DoNotOptimize(PreparedImage(image, {0, 0, 1296, 972}, CorrelationOptions()));
}
BENCHMARK(Prepare)->Unit(benchmark::kMillisecond);

void PrepareReference(benchmark::State& state) {
  const GrayImage image = Speckle(1, 1296, 972).Render(1296, 972);
  for (auto _ : state)
    benchmark::DoNotOptimize(CorrelationReference(image, {0, 0, 1296, 972}, CorrelationOptions()));
}
BENCHMARK(PrepareReference)->Unit(benchmark::kMillisecond);

void Shift(benchmark::State& state) {
  const Speckle speckle(1, 1296, 972, 2.0);
  ShapeFunction map;
  map.displacement_px = {-37.4, 52.3};
  const GrayImage before = speckle.Render(1296, 972), after = speckle.Render(1296, 972, map);
  for (auto _ : state) benchmark::DoNotOptimize(SearchShift(before, after, {0, 0, 1296, 972}, 60));
}
BENCHMARK(Shift)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace telestrain
