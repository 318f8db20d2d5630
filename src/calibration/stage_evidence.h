#pragma once

#include "calibration/bundle_adjustment.h"

namespace telestrain {

// Evidence that the global mirror image of the solution is excluded (MODEL.md 3).
struct StageEvidence {
  double axis_to_nominal_deg = 0;  // estimated stage axis against [stage] axis_in_array
  double rms_travel_error_um = 0;  // of the stage moves in the solution
  double twin_chi2_ratio = 0;      // cost of the mirror image over the cost of the solution
};

StageEvidence StudyStage(const Session& session, const CalibrationData& data,
                         const BundleResult& bundle);

// Fails (kEstimationFailed) when the seed's poses show a stage move of another length or direction
// than the table states: the seed knows every travel to a few micrometres.
Status RequireStatedTravels(const Session& session, const CalibrationData& data,
                            const std::vector<TargetPose>& poses);

}  // namespace telestrain
