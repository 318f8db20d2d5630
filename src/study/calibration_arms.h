#pragma once

#include <string>
#include <vector>

#include "study/corner_experiment.h"
#include "study/study.h"

namespace telestrain {

// One variant of the study of the paper's section 4: the same instrument with other noise, or with
// one of the paper's explanations for the U shape of the ruler's error switched on.
enum class ArmRole { kNoiseOfFit, kNoiseOfRuler, kExplanation, kAll };

struct CalibrationArm {
  ArmRole role = ArmRole::kExplanation;
  std::string name, differs;
  CornerExperiment experiment;
};

struct CalibrationArmOutcome {
  CalibrationArm arm;
  CornerOutcome outcome;
  ErrorFigures ruler_um, corner_px;
  Profile profile, systematic;  // of the ruler's error (um) over its place, with and without noise
  double edge_over_middle = 0;  // RMS of the outer fifth over that of the middle two fifths
  double systematic_edge_um = 0, systematic_middle_um = 0;  // the same without noise: RMS
};

// In order: noise 0.78 px, noise 0.395 px, then with 0.395 px: defocus, no cut-off boards, sparse
// sampling, certificates, and the four together. Fails like Calibrate, with the arm's name.
Result<std::vector<CalibrationArmOutcome>> RunCalibrationArms(const StudyOptions& options,
                                                              Console& console);

// The first of this role.
const CalibrationArmOutcome& ArmOf(const std::vector<CalibrationArmOutcome>& arms, ArmRole role);

}  // namespace telestrain
