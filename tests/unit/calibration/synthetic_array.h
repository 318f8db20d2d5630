#pragma once

#include <cstdint>
#include <vector>

#include "calibration/calibrate.h"
#include "session/session.h"

namespace telestrain::testing_support {

// A small counter-based generator: the same numbers on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double Uniform(double from, double to);
  double Normal(double sigma);

 private:
  std::uint64_t state_;
};

struct SyntheticOptions {
  std::uint64_t seed = 1;
  int poses = 9;  // each seen before and after a stage move of +1 mm
  double noise_px = 0.1;
  double max_tilt_deg = 4;
  double view_error_deg = 0.5;
  double k1_per_mm2 = 0;
  bool mirrored = false;   // v of every view reversed: views of the other handedness
  double stage_sense = 1;  // -1: the stage moves against its stated axis
};

// The four-view array of measurement-model section 13 with a true instrument that deviates from the
// nominal one, and exact or noisy corners of all boards. No image is involved.
struct SyntheticArray {
  Session session;
  TelecentricLens lens;                       // truth
  std::vector<TelecentricLens> lens_of_view;  // truth where every view has its own
  TargetShape shape;                          // truth: how the target deviates from nominal
  std::vector<TelecentricView> views;         // truth, in the nominal array frame
  std::vector<TargetPose> poses;              // one per calibration image
  std::vector<BoardObservation> boards;
};

SyntheticArray MakeSyntheticArray(const SyntheticOptions& options);

// All boards afresh, after the truth was changed.
void ObserveAgain(SyntheticArray& array, double noise_px, std::uint64_t seed);

// Throws when the calibration fails.
Calibration MustCalibrate(const SyntheticArray& array);

// Noisy pixels of a point in every view.
ImagePoint Observe(const SyntheticArray& array, std::size_t view, const Eigen::Vector3d& point,
                   double noise_px, Random& random);

}  // namespace telestrain::testing_support
