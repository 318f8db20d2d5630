#pragma once

#include "calibration/calibration_data.h"

namespace telestrain {

// Noise never repeats: an image with the very corners of an earlier one is a copy of it and would
// count its information twice. Takes such images out and lists them in CalibrationData::rejected.
void DropCopiedImages(const Session& session, CalibrationData& data);

}  // namespace telestrain
