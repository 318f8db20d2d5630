// A pipe state of the whole sensor: 4 views with 1000 points of 61 x 61 px each. Limit: twice the
// time that decoding its PNG takes on one core, on two threads. Both are timed in turn, so that
// what else the machine does meets both alike.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <ctime>

#include "measurement/pipe_measurement.h"
#include "simulation/experiment_truth.h"
#include "simulation/gray_png.h"
#include "simulation/nominal_session.h"
#include "simulation/pipe_image.h"
#include "simulation/sensor_readout.h"
#include "target/image_file.h"

namespace telestrain {
namespace {

constexpr double kRadius_mm = 4;
constexpr int kRounds = 9;

ArrayCalibration TrueCalibration(const VirtualInstrument& instrument) {
  ArrayCalibration array;
  array.lenses = {instrument.lens};
  array.model.distortion = {true, false, true, true, false};
  for (const InstrumentView& view : instrument.views) array.views.push_back(view.view);
  array.covariance = Eigen::MatrixXd::Zero(array.ParameterCount(), array.ParameterCount());
  array.covariance_of_noise = array.covariance;
  return array;
}

std::string Photograph(const VirtualInstrument& instrument, const PaintedPipe& paint,
                       const DeformedPipe& pipe, std::uint64_t key) {
  SensorModel sensor;
  sensor.noise_gray = 1.5;
  return EncodePng(ReadOut(RenderPipe(instrument, paint, pipe, 0), sensor, key)).value();
}

struct Spent {
  std::vector<double> wall_ms, cpu_ms;  // cpu: of all threads
};

template <class Work>
void Time(const Work& work, Spent& spent) {
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t cpu_start = std::clock();
  work();
  const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
  spent.wall_ms.push_back(wall.count());
  spent.cpu_ms.push_back(1000.0 * static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC);
}

double Median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

void StateOfFourViews(benchmark::State& state) {
  const VirtualExperimentOptions experiment;
  const Session session = NominalSession(experiment);
  const VirtualInstrument instrument = InventApparatus(experiment, session).instrument;
  const ArrayCalibration array = TrueCalibration(instrument);
  const PaintedPipe paint = PaintPipe(instrument, kRadius_mm, 7);
  DeformedPipe pipe;
  pipe.radius_mm = kRadius_mm;
  pipe.poisson_ratio = 0.31;
  pipe.origin_in_array_mm = {0, 0, -kRadius_mm};
  const std::string reference_png = Photograph(instrument, paint, pipe, 1);
  pipe.membrane_strain = 500e-6;
  pipe.origin_in_array_mm += Eigen::Vector3d(0.02, 0.01, 0.01);
  const std::string png = Photograph(instrument, paint, pipe, 2);

  PipeOptions options = DefaultPipeOptions(session);
  options.subset_px = 61;
  options.step_px = static_cast<int>(state.range(0));
  options.threads = 2;
  const PipeState table;
  PipeSequence sequence = PipeSequence::Start(session, array, options, table,
                                              DecodeGrayImage("", reference_png).value())
                              .value();
  GrayImage image;
  Spent decode, measure;
  MeasuredState measured;
  for (auto _ : state) {
    Time([&] { image = DecodeGrayImage("", png).value(); }, decode);
    Time([&] { measured = sequence.Measure(table, image).value(); }, measure);
  }
  state.counters["points/view"] = static_cast<double>(sequence.grid().points.size()) / 2;
  state.counters["used"] = measured.strain.points_used;
  state.counters["strain_error_ue"] = 1e6 * (measured.strain.axial_strain - pipe.membrane_strain);
  state.counters["decode_ms"] = Median(decode.wall_ms);
  state.counters["state_ms"] = Median(measure.wall_ms);
  state.counters["ratio"] = Median(measure.wall_ms) / Median(decode.wall_ms);
  // What the ratio is on two cores that nothing else uses, if both threads always have work.
  state.counters["cpu_ratio"] = Median(measure.cpu_ms) / 2 / Median(decode.cpu_ms);
}
BENCHMARK(StateOfFourViews)->Arg(29)->Arg(61)->Iterations(kRounds)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace telestrain
