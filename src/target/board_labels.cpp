#include "target/board_labels.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/numbers.h"

namespace telestrain {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix2i;

constexpr double kLeastMargin_rad = 0.35;  // 20 deg

// Turn of the rotation nearest to a 2x2 matrix of positive determinant.
double TurnOf(const Matrix2d& m) { return std::atan2(m(1, 0) - m(0, 1), m(0, 0) + m(1, 1)); }

double LargestStretch(const Matrix2d& m) { return m.jacobiSvd().singularValues()[0]; }

std::string SizeText(int columns, int rows) {
  return std::to_string(columns) + " x " + std::to_string(rows);
}

// (column, row) = steps (i, j) + origin; the inverse of a signed permutation is its transpose.
std::array<Matrix2i, 8> SignedPermutations() {
  std::array<Matrix2i, 8> all;
  std::size_t n = 0;
  for (const int swap : {0, 1})
    for (const int a : {1, -1})
      for (const int b : {1, -1}) {
        Matrix2i& m = all[n++];
        m.setZero();
        m(0, swap) = a;
        m(1, 1 - swap) = b;
      }
  return all;
}

// How one axis of the target runs over the grid.
struct AxisOnGrid {
  std::size_t axis = 0;
  bool reversed = false;
  int extent = 0, count = 0;
  bool border_at_first = false, border_at_last = false;  // in the target's sense
  bool continues = false;

  AxisOnGrid(const CornerGrid& grid, const BoardEnds& ends, const Matrix2i& steps, int target_axis,
             int board_count)
      : axis(steps(target_axis, 0) != 0 ? 0 : 1),
        reversed(steps.row(target_axis).sum() < 0),
        extent(grid.Extent(static_cast<int>(axis))),
        count(board_count) {
    const auto& [first, last] = ends[axis];
    border_at_first = (reversed ? last : first) == BeyondEnd::kBorder;
    border_at_last = (reversed ? first : last) == BeyondEnd::kBorder;
    continues = first == BeyondEnd::kContinues || last == BeyondEnd::kContinues;
  }
  bool IsWhole() const { return extent == count; }
  bool IsPossible() const {
    if (extent > count) return false;
    if (border_at_first && border_at_last) return IsWhole();
    return !(IsWhole() && continues);
  }
  bool IsAnchored() const { return IsWhole() || border_at_first || border_at_last; }
  // Coordinate of the grid's end that is nearest to the target's origin.
  int LeastCoordinate() const { return IsWhole() || border_at_first ? 0 : count - extent; }
};

struct Reading {
  Matrix2i steps = Matrix2i::Identity();
  double turn_rad = 10;
};

std::string WhyNotAnchored(const AxisOnGrid& axis, const CornerGrid& grid, bool columns) {
  if (axis.IsAnchored()) return {};
  const std::string what = columns ? "columns" : "rows", across = columns ? "rows" : "columns";
  return "cut off or covered at both ends of its " + across + ": " +
         SizeText(grid.Width(), grid.Height()) + " corners seen, the board's " + what +
         " cannot be counted; move the target so that one end of its " + across +
         ", with the border, is in the view";
}

int Origin(const AxisOnGrid& axis, const CornerGrid& grid) {
  const int first = axis.axis == 0 ? grid.first.first : grid.first.second;
  const int last = axis.axis == 0 ? grid.last.first : grid.last.second;
  return axis.LeastCoordinate() + (axis.reversed ? last : -first);
}

}  // namespace

std::string WhyAnotherPattern(const CornerLattice& lattice, const TargetSearch& search) {
  // A telecentric view shortens one direction of a tilted board and shows the other in full: the
  // larger stretch of the axes is the magnification, whatever the pose.
  const double found = LargestStretch(lattice.axes_px);
  const double wanted = LargestStretch(search.nominal_px_per_mm) * search.square_mm;
  if (!(found > 0.75 * wanted && found < 1.33 * wanted))
    return "another pattern: squares of " + FormatFixed(found, 1) +
           " px where the nominal view has " + FormatFixed(wanted, 1) + " px";
  const auto [narrow, wide] = std::minmax({lattice.Width(), lattice.Height()});
  const auto [rows, columns] = std::minmax({search.columns, search.rows});
  if (narrow > rows || wide > columns)
    return "another pattern: a grid of " + SizeText(wide, narrow) + " corners, the board has " +
           SizeText(search.columns, search.rows);
  return {};
}

BoardLabels LabelGrid(const CornerGrid& grid, const BoardEnds& ends, const TargetSearch& search) {
  const Matrix2d grid_from_nominal =
      (search.nominal_px_per_mm * search.square_mm).inverse() * grid.Axes_px();
  Reading best, second;
  for (const Matrix2i& steps : SignedPermutations()) {
    const AxisOnGrid x(grid, ends, steps, 0, search.columns), y(grid, ends, steps, 1, search.rows);
    if (!x.IsPossible() || !y.IsPossible()) continue;
    const Matrix2d turned = grid_from_nominal * steps.transpose().cast<double>();
    if (!(turned.determinant() > 0)) continue;
    const Reading reading{steps, std::abs(TurnOf(turned))};
    if (reading.turn_rad < best.turn_rad) {
      second = best;
      best = reading;
    } else if (reading.turn_rad < second.turn_rad) {
      second = reading;
    }
  }
  BoardLabels labels;
  if (best.turn_rad > 3.2) {
    labels.refused_because =
        "another pattern: the borders about " + SizeText(grid.Width(), grid.Height()) +
        " corners do not fit a board of " + SizeText(search.columns, search.rows);
    return labels;
  }
  if (second.turn_rad - best.turn_rad < kLeastMargin_rad) {
    labels.refused_because = "turned too far from the nominal view to tell the board's ends apart";
    return labels;
  }
  labels.steps = best.steps;
  const AxisOnGrid x(grid, ends, best.steps, 0, search.columns),
      y(grid, ends, best.steps, 1, search.rows);
  labels.refused_because = WhyNotAnchored(x, grid, true);
  if (labels.refused_because.empty()) labels.refused_because = WhyNotAnchored(y, grid, false);
  labels.origin = {Origin(x, grid), Origin(y, grid)};
  return labels;
}

}  // namespace telestrain
