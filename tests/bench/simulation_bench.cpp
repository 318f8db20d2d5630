// Speed of the virtual experiment's images, 2592 x 1944 px: ms per stage, and as a ratio to
// encoding the PNG of the same image in the same run (counter PNGs), which does not depend on how
// fast the machine is at the moment. Arguments: threads; numerical aperture in thousandths.
#include <benchmark/benchmark.h>

#include <chrono>

#include "simulation/gray_png.h"
#include "simulation/load_case.h"
#include "simulation/nominal_session.h"
#include "simulation/pipe_image.h"
#include "simulation/plate_image.h"
#include "simulation/sensor_readout.h"

namespace telestrain {
namespace {

constexpr SensorModel kSensor{8, 1.5, 10000};

struct Scene {
  Session session;
  VirtualInstrument instrument;
  PaintedPipe paint;
  DeformedPipe pipe;
  PlatePose pose;

  explicit Scene(double numerical_aperture) {
    VirtualExperimentOptions options;
    options.numerical_aperture = numerical_aperture;
    session = NominalSession(options);
    instrument = MakeInstrument(options, session);
    pipe = PipeUnderLoad(options, session.pipe, 1);
    pipe.origin_in_array_mm.z() = -pipe.radius_mm;
    paint = PaintPipe(instrument, pipe.radius_mm, 7);
    pose.origin_in_array_mm = {0.1, -0.2, 0.5};
  }
  GrayImage Plate(int threads) const {
    return RenderPlate(instrument, session.target, pose, threads);
  }
  GrayImage Pipe(int threads) const { return RenderPipe(instrument, paint, pipe, threads); }
};

Scene SceneOf(const benchmark::State& state) {
  return Scene(1e-3 * static_cast<double>(state.range(1)));
}

double Seconds(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Runs `work` and beside it, in turn, the encoding of `image` that it is compared with.
void Compare(benchmark::State& state, const GrayImage& image, const auto& work) {
  double work_s = 0, png_s = 0;
  for (auto _ : state) {
    const double once_s = Seconds(work);
    state.SetIterationTime(once_s);
    work_s += once_s;
    png_s += Seconds([&] { benchmark::DoNotOptimize(EncodePng(image)); });
  }
  state.counters["PNGs"] = work_s / png_s;
}

void Plate(benchmark::State& state) {
  const Scene scene = SceneOf(state);
  const int threads = static_cast<int>(state.range(0));
  const GrayImage image = ReadOut(scene.Plate(threads), kSensor, 1);
  Compare(state, image, [&] { benchmark::DoNotOptimize(scene.Plate(threads)); });
}

void Pipe(benchmark::State& state) {
  const Scene scene = SceneOf(state);
  const int threads = static_cast<int>(state.range(0));
  const GrayImage image = ReadOut(scene.Pipe(threads), kSensor, 1);
  Compare(state, image, [&] { benchmark::DoNotOptimize(scene.Pipe(threads)); });
}

void WholePlate(benchmark::State& state) {
  const Scene scene = SceneOf(state);
  const int threads = static_cast<int>(state.range(0));
  const GrayImage image = ReadOut(scene.Plate(threads), kSensor, 1);
  Compare(state, image, [&] {
    benchmark::DoNotOptimize(EncodePng(ReadOut(scene.Plate(threads), kSensor, 1, threads)));
  });
}

void WholePipe(benchmark::State& state) {
  const Scene scene = SceneOf(state);
  const int threads = static_cast<int>(state.range(0));
  const GrayImage image = ReadOut(scene.Pipe(threads), kSensor, 1);
  Compare(state, image, [&] {
    benchmark::DoNotOptimize(EncodePng(ReadOut(scene.Pipe(threads), kSensor, 1, threads)));
  });
}

void Noise(benchmark::State& state) {
  const GrayImage ideal = Scene(0).Plate(2), image = ReadOut(ideal, kSensor, 1);
  Compare(state, image, [&] { benchmark::DoNotOptimize(ReadOut(ideal, kSensor, 1)); });
}

void Cases(benchmark::internal::Benchmark* bench) {
  for (const int threads : {1, 2})
    for (const int aperture : {0, 10}) bench->Args({threads, aperture});
  bench->UseManualTime()->Unit(benchmark::kMillisecond);
}
BENCHMARK(Plate)->Apply(Cases);
BENCHMARK(Pipe)->Apply(Cases);
BENCHMARK(WholePlate)->Apply(Cases);
BENCHMARK(WholePipe)->Apply(Cases);
BENCHMARK(Noise)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace telestrain
