#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration_record.h"
#include "diagnostics/independent_optimum.h"
#include "diagnostics/length_uncertainty.h"
#include "diagnostics/pinhole_comparison.h"
#include "diagnostics/projection_uncertainty.h"
#include "diagnostics/residual_pattern.h"

namespace telestrain {

// All that lets a reviewer believe a calibration without believing us.
struct Diagnosis {
  ResidualList residuals;
  // What the corners' own covariances leave after the fit, per scalar.
  double expected_rms_px = 0;
  bool noise_is_from_residuals = false;     // then their size says nothing
  std::vector<OutlierPass> outlier_replay;  // by mrcal's rule
  ResidualVerdict verdict;
  std::vector<PatternFinding> left_out;  // what is wrong with boards that the calibration left out
  std::optional<IndependentOptimum> optimum;
  std::string optimum_missing_because;      // where there is none
  std::vector<UncertaintyMap> maps;         // one per view
  std::optional<LengthUncertainty> length;  // what they mean; nothing with one group
  std::string length_missing_because;
  std::optional<PinholeComparison> pinhole;
  std::string pinhole_missing_because;
};

// `observations`: every board as detected, for those that the calibration left out; `crosses`: of
// the ruler, for the pinhole arm. What one of the checks cannot do is stated, not an error. Fails
// when the covariance cannot be found again or an observation is not of the session.
Result<Diagnosis> Diagnose(const Session& session, const CalibrationRecord& record,
                           const std::vector<BoardObservation>& observations,
                           const std::vector<CrossObservation>& crosses);

// The part `uncertainty` of mrcal.json: the maps and what they mean.
nlohmann::ordered_json UncertaintyJson(const Diagnosis& diagnosis);

inline constexpr const char* kDiagnosisSchema = "telestrain.mrcal/1";

// mrcal.json; `made_from` names the inputs with their SHA-256.
nlohmann::ordered_json DiagnosisJson(const Session& session, const CalibrationRecord& record,
                                     const Diagnosis& diagnosis,
                                     const std::map<std::string, std::string>& made_from);

}  // namespace telestrain
