#pragma once

#include <vector>

#include "base/result.h"
#include "simulation/plate_image.h"

namespace telestrain {

// A target pose and the same pose after the stage's travel.
struct PosePair {
  PlatePose at_start;
  PlatePose after_travel;
  bool is_cut_off = false;  // on purpose: one view sees its board only in part
};

// What to look for: poses in the field, `travel_in_array_mm` apart.
struct PosePlanRequest {
  int whole_poses = 0;    // every board whole in every view, before and after the travel
  int cut_off_poses = 0;  // exactly one board cut off in exactly one view
  double tilt_deg = 8;    // half range of the rotation about the array's x
  std::uint64_t key = 0;  // of the randomness
  std::vector<Eigen::Vector3d> travels_in_array_mm;  // one per pose, or empty: no travel
};

// Poses that fill the common field and the depth of field evenly: a Halton sequence over
// translation and rotation, filtered by what the views see, thinned to the candidates farthest
// from each other. The first pose is the most central one; cut-off poses are spread among the
// others. The range is what the array allows: the plate's length leaves little rotation about its
// normal (13.85 mm sin 4 deg = 1 mm of the 4.3 mm field) and about y (depth of field).
// Fails (kBadInput) when too few poses fit, which happens for an array far from its drawing.
Result<std::vector<PosePair>> PlanPoses(const VirtualInstrument& instrument,
                                        const TargetSpec& plate, const PosePlanRequest& request);

}  // namespace telestrain
