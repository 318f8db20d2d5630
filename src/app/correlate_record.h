#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/correlate_setup.h"
#include "correlation/field_summary.h"

namespace telestrain {

inline constexpr const char* kCorrelateSchema = "telestrain.correlate/1";
inline constexpr const char* kPatternSchema = "telestrain.pattern/1";

// What correlate.json says of one image.
struct ImageRecord {
  std::string name, sha256, stem;  // of the file, of its bytes, of its results
  FieldSummary summary;
  int reference_updates = 0;
};

// Options, hashes of the inputs, definitions, and per image points by status, means and noise. The
// number of threads is left out: the results do not depend on it.
nlohmann::ordered_json CorrelateJson(const CorrelateSetup& setup, const InputImage& reference,
                                     const std::vector<ImageRecord>& images);

// pattern.json: the assessment with the subset and step that are used.
nlohmann::ordered_json PatternFileJson(const CorrelateSetup& setup, const InputImage& reference);

}  // namespace telestrain
