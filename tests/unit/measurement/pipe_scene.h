#pragma once

#include <cstdint>

#include "measurement/pipe_measurement.h"
#include "simulation/experiment_truth.h"
#include "simulation/nominal_session.h"
#include "simulation/pipe_image.h"
#include "simulation/sensor_readout.h"

namespace telestrain::testing_support {

// A painted pipe before the true instrument, whose calibration is exact.
struct PipeScene {
  static constexpr double kRadius_mm = 4;

  VirtualExperimentOptions options;
  Session session;
  VirtualInstrument instrument;
  ArrayCalibration array;
  PaintedPipe paint;

  explicit PipeScene(const VirtualExperimentOptions& experiment)
      : options(experiment),
        session(NominalSession(options)),
        instrument(InventApparatus(options, session).instrument),
        paint(PaintPipe(instrument, kRadius_mm, 7)) {
    array.lenses = {instrument.lens};
    for (const InstrumentView& view : instrument.views) array.views.push_back(view.view);
    array.covariance = Eigen::MatrixXd::Zero(array.ParameterCount(), array.ParameterCount());
    array.covariance_of_noise = array.covariance;
  }

  static DeformedPipe AtRest() {
    DeformedPipe pipe;
    pipe.radius_mm = kRadius_mm;
    pipe.poisson_ratio = 0.31;
    pipe.origin_in_array_mm = {0.02, -0.05, -kRadius_mm};
    return pipe;
  }
  GrayImage Render(const DeformedPipe& pipe) const {
    return RenderPipe(instrument, paint, pipe, 0);
  }
  GrayImage Photograph(const DeformedPipe& pipe, double noise_gray, std::uint64_t key) const {
    SensorModel sensor;
    sensor.noise_gray = noise_gray;
    return ReadOut(Render(pipe), sensor, key);
  }
};

// Small images: 4 x 4 px of the sensor are one.
inline VirtualExperimentOptions Binned() {
  VirtualExperimentOptions options;
  options.binning = 4;
  return options;
}

}  // namespace telestrain::testing_support
