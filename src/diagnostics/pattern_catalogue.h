#pragma once

#include <vector>

#include "diagnostics/pattern_system.h"
#include "diagnostics/residual_pattern.h"

// Private to the diagnostics module: the patterns that are known, and their words.
namespace telestrain {

// A pattern that every image has a part in: combinations of the system's global columns.
struct KnownPattern {
  PatternKind kind = PatternKind::kUnknown;
  int view = -1, board = -1;
  Eigen::MatrixXd columns;             // PatternSystem::Size() rows
  std::vector<std::string> names;      // of the columns' parameters, with the unit shown
  std::vector<double> shown_per_unit;  // shown value per unit of the column
};

// What the calibration adjusted beside the poses.
Eigen::MatrixXd AdjustedColumns(const PatternSystem& system, const CalibrationData& data,
                                const ArrayState& state);

// All patterns of the lens, the views and the boards, but kViewOffset. What the calibration
// adjusted among them is invisible to its residuals and explains nothing.
std::vector<KnownPattern> KnownPatterns(const PatternSystem& system, const CalibrationData& data,
                                        const ArrayState& state);
// An offset of every view; to be asked before AdjustedColumns are taken out.
std::vector<KnownPattern> ViewOffsets(const PatternSystem& system, const ArrayState& state);

// The calibration's own choices, for adjusting again.
BundleOptions OptionsOf(const CalibrationData& data, const ArrayState& state);

// Fills name, text and remedy from the rest.
void Describe(const CalibrationData& data, const ArrayState& state, PatternFinding& finding);

}  // namespace telestrain
