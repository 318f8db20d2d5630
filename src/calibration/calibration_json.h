#pragma once

#include <nlohmann/json.hpp>

#include "calibration/calibrate.h"

// Private to calibration_file.cpp: how the parts of calibration.json are written.
namespace telestrain {

// All entries of a matrix in one list, row by row.
template <typename Derived>
nlohmann::ordered_json ArrayOf(const Eigen::MatrixBase<Derived>& values) {
  nlohmann::ordered_json array = nlohmann::ordered_json::array();
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index j = 0; j < values.cols(); ++j) array.push_back(values(i, j));
  return array;
}

// The keys that say why the calibration may be believed: stage_decision, branch_screening,
// model_tests, cross_validation, target, gauge.
nlohmann::ordered_json EvidenceJson(const Session& session, const Calibration& calibration);

}  // namespace telestrain
