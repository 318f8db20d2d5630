#pragma once

#include <string>
#include <vector>

#include "study/image_experiment.h"

namespace telestrain {

enum class ModelKind {
  kTelecentric,
  kLockedPinhole,    // focal length fixed by a stated working distance, five coefficients a view
  kFreePinhole,      // focal length and five coefficients free
  kCenteredPinhole,  // locked, and told where the lens has its centre
};

// Working distances that pinholes are locked to.
inline constexpr double kNearDistance_mm = 110, kMiddleDistance_mm = 1000, kFarDistance_mm = 100000;

// One camera model's fit to the corners of a session, and the rulers measured with it.
struct ModelOutcome {
  ModelKind kind = ModelKind::kTelecentric;
  std::string name;
  double working_distance_mm = 0;       // of a pinhole; where a free one starts
  double rms_px = 0;                    // over scalar coordinates
  std::vector<double> corner_error_px;  // norms
  std::vector<double> ruler_error_um;   // against the certified length
  std::string remark;                   // how the fit ended

  double RulerRms_um() const;
};

// The telecentric model, then pinholes locked to 110 mm .. 100 m, two free ones, and at last the
// locked one at 100 m with the lens's centre: all on the same corners, weights and crosses.
Result<std::vector<ModelOutcome>> FitModels(const ImageOutcome& images, Console& console);

// "110 mm", "3 m".
std::string DistanceText(double distance_mm);

}  // namespace telestrain
