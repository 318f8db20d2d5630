#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "simulation/deformed_pipe.h"
#include "simulation/pose_plan.h"

namespace telestrain {

// One plate image as it truly was.
struct PlateTruth {
  std::string image;
  std::string pose;
  double stage_mm = 0;  // nominal
  PlatePose plate;
  bool is_cut_off = false;
};

// One pipe image as it truly was.
struct PipeTruth {
  PipeState state;
  DeformedPipe pipe;
};

// Everything that an evaluation of the session has to find.
struct ExperimentTruth {
  VirtualInstrument instrument;
  Eigen::Vector3d stage_axis_in_array = Eigen::Vector3d::UnitZ();
  TargetSpec target;  // with its true separation
  TargetSpec ruler;   // two crosses
  double ruler_length_mm = 0;
  std::vector<PlateTruth> calibration;
  std::vector<PlateTruth> rulers;
  std::vector<PipeTruth> pipe;  // the first one is the reference
};

// The instrument, the stage's axis and the artefacts as they truly are, without any image yet.
ExperimentTruth InventApparatus(const VirtualExperimentOptions& options, const Session& nominal);

// Invents the whole experiment; fails when no pose fits into the field.
Result<ExperimentTruth> InventTruth(const VirtualExperimentOptions& options,
                                    const Session& nominal);

// The truth as JSON, schema "telestrain.truth/1".
nlohmann::ordered_json TruthJson(const VirtualExperimentOptions& options,
                                 const ExperimentTruth& truth);

}  // namespace telestrain
