// Speed of whole fields: from nothing known, per image of a sequence, assessing a pattern, finding
// the textured region.
#include <benchmark/benchmark.h>

#include "correlation/correlation_field.h"
#include "correlation/field_tracker.h"
#include "correlation/pattern_assessment.h"
#include "correlation/texture_region.h"
#include "tests/unit/correlation/speckle.h"

namespace telestrain {
namespace {

constexpr int kSide = 1000;

ShapeFunction SmallStrain() {
  ShapeFunction map;
  map.displacement_px = {2.3, -1.4};
  map.gradient << 5e-4, 1e-4, -1e-4, -2e-4;
  return map;
}

struct Pair {
  GrayImage before, after;
};
const Pair& Images() {
  static const Pair pair = [] {
    const Speckle speckle(1, kSide, kSide);
    std::mt19937 random(2);
    Pair made{speckle.Render(kSide, kSide),
              speckle.Render(kSide, kSide, SmallStrain(), {kSide / 2, kSide / 2})};
    AddNoise(1, random, made.before);
    AddNoise(1, random, made.after);
    return made;
  }();
  return pair;
}

FieldOptions Options() {
  FieldOptions options;
  options.correlation.subset_px = 33;
  options.correlation.threads = 1;
  options.step_px = 5;
  return options;
}

void CountPoints(benchmark::State& state, const CorrelationField& field) {
  for (const FieldPoint& point : field.points)
    if (!point.match.ok()) state.SkipWithError("a point failed");
  state.counters["points"] = static_cast<double>(field.points.size());
  state.counters["points/s"] = benchmark::Counter(
      static_cast<double>(field.points.size() * state.iterations()), benchmark::Counter::kIsRate);
}

// Reference, seeds, field and strain.
void FromNothing(benchmark::State& state) {
  const FieldOptions options = Options();
  CorrelationField field;
  for (auto _ : state) {
    const CorrelationReference reference(Images().before, {0, 0, kSide, kSide},
                                         options.correlation);
    field = Correlate(reference, Images().after, options);
  }
  CountPoints(state, field);
}
BENCHMARK(FromNothing)->Unit(benchmark::kMillisecond);

void ImageOfASequence(benchmark::State& state) {
  FieldTracker tracker = *FieldTracker::Start(Images().before, Options());
  CorrelationField field = tracker.Track(Images().after);
  for (auto _ : state) field = tracker.Track(Images().after);
  CountPoints(state, field);
}
BENCHMARK(ImageOfASequence)->Unit(benchmark::kMillisecond);

// 5 Mpx from the pattern of one.
GrayImage Large() {
  constexpr int kWidth = 2592, kHeight = 1944;
  GrayImage image{kWidth, kHeight, 255, {}};
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      image.pixels.push_back(Images().before.At(x % kSide, y % kSide));
  return image;
}

void Assess(benchmark::State& state) {
  const GrayImage image = Large();
  for (auto _ : state) benchmark::DoNotOptimize(AssessPattern(image, Options()));
}
BENCHMARK(Assess)->Unit(benchmark::kMillisecond);

void FindTexture(benchmark::State& state) {
  const GrayImage image = Large();
  for (auto _ : state)
    benchmark::DoNotOptimize(TextureRegion(image, Options().correlation.subset_px));
}
BENCHMARK(FindTexture)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace telestrain
