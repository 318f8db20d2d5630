#pragma once

#include <string>
#include <vector>

#include "calibration/array_seed.h"

namespace telestrain {

// Fails (kEstimationFailed) when the images show fewer than three different poses: one that was
// taken again and again may fit well, but it determines nothing.
Status RequireDifferentPoses(const std::vector<TargetPose>& poses);

// Why the images cannot determine the calibration, in words a person at the stage can act on: too
// few different poses, a target that always faces a view, one orientation in all images. When no
// such cause is found, `otherwise` (what the solver or the covariance said) is the answer.
std::string ExplainWeakInput(const Session& session, const CalibrationData& data,
                             const std::vector<TargetPose>& poses, const std::string& otherwise);

}  // namespace telestrain
