#pragma once

#include <vector>

#include "diagnostics/residual_labels.h"

// Private to the diagnostics module: which board of an image is to blame.
namespace telestrain {

struct ImageMisfit {
  // Index into the boards of the one without which the others fit one pose as well as noise lets
  // them; -1 when there is none.
  int culprit = -1;
  TargetPose pose;      // of the target, from the other boards
  LabelReading labels;  // of the culprit
};

// Fits the pose of the target to the boards of one image but one, for each in turn, with the views
// of `array` as they are, which must come from other images. `sigma0` is the size of the noise over
// the stated one. An image whose boards but one are seen from one direction only has no culprit.
ImageMisfit ExamineImage(const std::vector<BoardData>& boards, const TargetSpec& target,
                         const ArrayState& array, const TargetPose& start, double sigma0);

// Whether the directions of these boards' views determine a pose.
bool ViewsDeterminePose(const std::vector<BoardData>& boards, const ArrayCalibration& array);

}  // namespace telestrain
