#include "simulation/image_conditions.h"

#include <cmath>
#include <numbers>

#include "simulation/random_keys.h"

namespace telestrain {
namespace {

// Uniform on the sphere: height and longitude are.
Eigen::Vector3d RandomDirection(RandomStream& random) {
  const double z = random.Uniform(-1, 1), angle = random.Uniform(0, 2 * std::numbers::pi);
  const double across = std::sqrt(1 - z * z);
  return {across * std::cos(angle), across * std::sin(angle), z};
}

}  // namespace

VirtualInstrument InstrumentAtImage(const VirtualExperimentOptions& options,
                                    const VirtualInstrument& warm, int number) {
  VirtualInstrument instrument = warm;
  RandomStream motion(CombineKeys(RandomKey(options.seed, RandomPurpose::kVibration),
                                  static_cast<std::uint64_t>(number)));
  instrument.vibration_in_array_mm = 1e-3 * options.vibration_um * RandomDirection(motion);

  const double time_s = options.preheat_s + number * options.image_interval_s;
  const double cold = std::exp(-time_s / options.warmup_time_s);
  instrument.lens.magnification_px_per_mm *= 1 + 1e-6 * options.warmup_drift_ppm * cold;
  RandomStream drift(RandomKey(options.seed, RandomPurpose::kWarmUp));
  for (InstrumentView& view : instrument.views) {
    const double angle = drift.Uniform(0, 2 * std::numbers::pi);
    view.view.offset_mm +=
        1e-3 * options.warmup_drift_um * cold * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  return instrument;
}

}  // namespace telestrain
