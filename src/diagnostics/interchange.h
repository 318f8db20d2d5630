#pragma once

#include <map>
#include <string>

#include "calibration/calibration_record.h"
#include "session/session.h"

namespace telestrain {

// A calibration in the formats of other programs. Numbers read back to the same value.

// A view as mrcal's camera model (mrcal.org, the text format of .cameramodel). mrcal knows no
// telecentric camera, so this is the pinhole at the distance D = kMrcalDistance_mm with focal
// length m D (mrcal_telecentric.h). Lengths are mm. mrcal.project of a point of the array's frame,
// transformed by the extrinsics, is ArrayCalibration::Project to q z / D for q px from the axis and
// the depth z: 1e-7 px. The model is LENSMODEL_PINHOLE without distortion, else LENSMODEL_OPENCV4,
// with k3 LENSMODEL_OPENCV5. What it leaves out is the lens's residual telecentricity, which
// parallel rays cannot have; the comment lines say how much that is.
std::string CameraModelText(const Session& session, const ArrayCalibration& array, int view);

// All views for cv::FileStorage (YAML). The comments of the file explain every key and the
// equations, which are complete: they give ArrayCalibration::Project to rounding.
std::string OpenCvText(const Session& session, const ArrayCalibration& array);

// corners.vnl (target/corners_file.h) of the corners that the calibration used; others are missing.
std::string UsedCornersText(const Session& session, const CalibrationData& data);

// All of them by file name: a <view>.cameramodel per view, opencv.yaml and corners.vnl. Fails
// (kBadInput) when the name of a view cannot be that of a file.
Result<std::map<std::string, std::string>> InterchangeFiles(const Session& session,
                                                            const CalibrationRecord& record);

}  // namespace telestrain
