#pragma once

#include <optional>
#include <string>
#include <vector>

#include "optics/optical_rig.h"

namespace telestrain {

// What moves in the image of a view when one of its mirrors is not where it should be.

enum class MirrorError { kTurnInPlane, kTurnAcross, kShift };

inline constexpr double kMirrorTurn_rad = 1e-3;
inline constexpr double kMirrorShift_mm = 0.01;

struct MirrorSensitivity {
  std::string view;
  int mirror = 0;  // 0 is the one nearest to the lens
  // A turn by kMirrorTurn_rad about the in-plane axis within the plane of incidence, or about the
  // one across it (both through the middle ray's hit), or a shift of kMirrorShift_mm along the
  // normal.
  MirrorError error = MirrorError::kShift;
  double field_shift_mm = 0;  // of the object point that the middle pixel sees, at its focus
  double field_shift_px = 0;
  double direction_mrad = 0;                // turn of the viewing direction
  double roll_mrad = 0;                     // turn of the image about the viewing direction
  std::optional<double> stereo_angle_mrad;  // change, signed; absent without a partner
  // Error of the distance between the outermost groups' centres when the mirror moves and the
  // calibration does not follow; absent without two groups of two views.
  std::optional<double> length_error_um;
  std::optional<double> strain_error_microstrain;
};

// Central differences through the chain of reflections; three entries per mirror and path. The
// normal points towards the light; with d the light's direction, the turn axes are normal x d and
// (normal x d) x normal, right-handed.
std::vector<MirrorSensitivity> SensitivityOf(const OpticalRig& rig);

}  // namespace telestrain
