#pragma once

#include <vector>

#include "measurement/strain_results.h"
#include "measurement/uncertainty.h"

namespace telestrain {

// A strain (plain ratio) with its standard uncertainty and where that comes from.
struct StrainValue {
  double value = 0;
  double standard_uncertainty = 0;  // root sum of squares of the budget
  std::vector<BudgetLine> budget;
};

// Largest bias of a subset match over the sub-pixel positions, px: measured 0.0002 on soft, 0.0003
// on sharp and 0.0012 on aliased patterns.
inline constexpr double kCorrelationBias_px = 1.2e-3;

// One state as the tracking and the triangulation give it.
struct StateInput {
  const ArrayCalibration& array;
  const PipeGrid& grid;
  const std::vector<TrackedPoint>& tracked;
  const StrainModel& model;
};

// Where a tracked point was and how far it moved, seen through `array`; `epipolar_change_px` is how
// much the redundant distance between its two rays changed.
struct LocatedPoint {
  DisplacedPoint point;
  double epipolar_change_px = 0;
};
LocatedPoint Locate(const ArrayCalibration& array, const PipeGrid& grid, const PipePoint& point,
                    const TrackedPoint& tracked);

// The entries of `results` with their budgets (MODEL.md 9.4), each of the five lines
//   "image noise"         from the matches' covariances, or the scatter when that is larger
//   "correlation bias"    b sin(2 pi shift + phase) px in every view and image direction, one
//                         amplitude (rectangular, kCorrelationBias_px) and one phase (unknown) per
//                         view and direction: correlated between points that moved alike
//   "calibration"         of the calibration's own images. It holds what a wrong calibration makes
//                         of the rigid motion, which is part of every displacement
//   "target certificate"  of the target that calibrated
//   "fibre"               the place of the fibre, when the pipe bends: of the axis, of a gauge's
//                         angle, and the noise of what bending adds up to the stated fibre
std::vector<StrainValue> StrainWithBudgets(
    const StateInput& input, const std::vector<DisplacedPoint>& points,
    const std::vector<std::vector<std::size_t>>& index_of_group, const StrainResults& results);

}  // namespace telestrain
