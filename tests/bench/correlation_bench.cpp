// Speed of the subset correlation: points/s, ns per pixel and iteration, by vector level, degree
// and order; preparing images; two threads.
#include <benchmark/benchmark.h>

#include "correlation/kernels.h"
#include "correlation/subset_correlation.h"
#include "tests/unit/correlation/speckle.h"

namespace telestrain {
namespace {

using correlation::SetVectorLevel;
using correlation::VectorLevel;

// Matches points from a start that is 0.2 px off, the work on the reference included.
void MatchPoints(benchmark::State& state, const ShapeFunction& map,
                 const CorrelationOptions& options, int threads = 1) {
  const int side = options.subset_px > 200 ? 900 : 512;
  const PixelRegion region{0, 0, side, side};
  const Eigen::Vector2d about = region.Middle();
  const Speckle speckle(1, side, side);
  std::mt19937 random(2);
  GrayImage before = speckle.Render(side, side), after = speckle.Render(side, side, map, about);
  AddNoise(1, random, before);
  AddNoise(1, random, after);
  const CorrelationReference reference(before, region, options);
  const bool other_view = map.gradient.norm() > 0.1;
  const PreparedImage image(after, region, options,
                            other_view ? map.gradient : Eigen::Matrix2d::Zero().eval());
  const bool large = options.subset_px > 200;
  const auto centers =
      GridOfCenters(region, large ? options.subset_px / 2 + 20 : 150, large ? 100 : 10);
  double points = 0, iterations = 0;
  for (auto _ : state) {
    for (const auto& center : centers) {
      ShapeFunction start = TruthAt(map, about, center);
      start.displacement_px += Eigen::Vector2d(0.2, -0.2);
      const SubsetMatch match = reference.Match(center, image, start, threads);
      iterations += match.iterations;
      ++points;
      if (!match.ok()) state.SkipWithError("a point failed");
    }
  }
  const double pixels = static_cast<double>(options.subset_px) * options.subset_px;
  state.counters["points/s"] = benchmark::Counter(points, benchmark::Counter::kIsRate);
  state.counters["s/px/iteration"] = benchmark::Counter(
      iterations * pixels, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["iterations"] = iterations / points;
}

ShapeFunction SmallStrainMap() {
  ShapeFunction map;
  map.displacement_px = {0.3, 0.4};
  map.gradient << 5e-4, 1e-4, -1e-4, -2e-4;
  return map;
}

// Arguments: subset, degree of the spline, order, vector level (0 plain, 1 AVX2, 2 AVX-512).
void SmallStrain(benchmark::State& state) {
  if (!SetVectorLevel(static_cast<VectorLevel>(state.range(3))))
    return state.SkipWithError("this machine lacks the vector level");
  CorrelationOptions options;
  options.subset_px = static_cast<int>(state.range(0));
  options.interpolation = state.range(1) == 3 ? Interpolation::kCubic : Interpolation::kQuintic;
  options.shape_order = static_cast<int>(state.range(2));
  MatchPoints(state, SmallStrainMap(), options);
  SetVectorLevel(correlation::BestVectorLevel());
}
BENCHMARK(SmallStrain)
    ->ArgNames({"subset", "degree", "order", "level"})
    ->ArgsProduct({{33}, {3, 5}, {0, 1, 2}, {2}})
    ->ArgsProduct({{33, 61, 501}, {5}, {1}, {0, 1, 2}})
    ->Unit(benchmark::kMillisecond);

// The rows of a few large subsets on one and two threads.
void SharedRows(benchmark::State& state) {
  CorrelationOptions options;
  options.subset_px = 501;
  MatchPoints(state, SmallStrainMap(), options, static_cast<int>(state.range(0)));
}
BENCHMARK(SharedRows)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

// Many points on one and two threads.
void Points(benchmark::State& state) {
  CorrelationOptions options;
  options.subset_px = 33;
  options.threads = static_cast<int>(state.range(0));
  const PixelRegion region{0, 0, 900, 900};
  const Speckle speckle(1, 900, 900);
  const CorrelationReference reference(speckle.Render(900, 900), region, options);
  const PreparedImage image(speckle.Render(900, 900, SmallStrainMap(), region.Middle()), region,
                            options);
  const auto centers = GridOfCenters(region, 30, 6);
  for (auto _ : state)
    benchmark::DoNotOptimize(CorrelatePoints(reference, centers, image, {ShapeFunction()}));
  state.counters["points/s"] = benchmark::Counter(
      static_cast<double>(centers.size() * state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(Points)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

void StereoGradient(benchmark::State& state) {
  ShapeFunction map;
  map.displacement_px = {0.3, 0.4};
  map.gradient << -0.4, 0.1, 0.05, 0.1;
  CorrelationOptions options;
  options.subset_px = static_cast<int>(state.range(0));
  MatchPoints(state, map, options);
}
BENCHMARK(StereoGradient)->Arg(33)->Arg(61)->Unit(benchmark::kMillisecond);

// 5 Mpx on one core; bytes a pixel are those of image and prepared image together.
constexpr int kWidth = 2592, kHeight = 1944;

GrayImage Large() {
  const GrayImage tile = Speckle(1, 256, 256).Render(256, 256);
  GrayImage image{kWidth, kHeight, 255, {}};
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) image.pixels.push_back(tile.At(x % 256, y % 256));
  return image;
}

void Prepare(benchmark::State& state) {
  SetVectorLevel(static_cast<VectorLevel>(state.range(0)));
  const GrayImage image = Large();
  const CorrelationOptions options{.threads = 1};
  std::size_t bytes = 0;
  for (auto _ : state) bytes = PreparedImage(image, {0, 0, kWidth, kHeight}, options).bytes();
  state.counters["bytes/px"] =
      static_cast<double>(bytes + image.pixels.size() * sizeof(float)) / (kWidth * kHeight);
  SetVectorLevel(correlation::BestVectorLevel());
}
BENCHMARK(Prepare)->ArgName("level")->Arg(0)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

void PrepareReference(benchmark::State& state) {
  const GrayImage image = Large();
  const CorrelationOptions options{.threads = 1};
  for (auto _ : state)
    benchmark::DoNotOptimize(CorrelationReference(image, {0, 0, kWidth, kHeight}, options));
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
