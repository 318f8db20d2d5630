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
using Eigen::Vector2d;

constexpr double kLeastMargin_rad = 0.35;  // 20 deg
// Of the whole board: the corners that are missing are then looked for where they must be.
constexpr double kLeastFilling = 0.75;
// A corner nearer to the view's edge cannot be measured.
constexpr double kEdgeMargin_px = 1;

// A way to read the grid: column c and row r of the board are at corner + c along + r up.
struct Reading {
  LatticeIndex corner;
  LatticeIndex along, up;

  LatticeIndex At(int column, int row) const {
    return {corner.first + column * along.first + row * up.first,
            corner.second + column * along.second + row * up.second};
  }
  Matrix2d Axes(const CornerLattice& lattice) const {
    Matrix2d axes;
    axes << lattice.axes_px * Vector2d(along.first, along.second),
        lattice.axes_px * Vector2d(up.first, up.second);
    return axes;
  }
};

// All readings of a grid that fills columns x rows.
std::vector<Reading> Readings(const CornerLattice& lattice, int columns, int rows) {
  std::vector<Reading> readings;
  for (const bool swapped : {false, true}) {
    const int width = swapped ? rows : columns, height = swapped ? columns : rows;
    if (lattice.Width() != width || lattice.Height() != height) continue;
    for (const int sx : {1, -1})
      for (const int sy : {1, -1}) {
        Reading reading;
        reading.corner = {sx > 0 ? lattice.first.first : lattice.last.first,
                          sy > 0 ? lattice.first.second : lattice.last.second};
        reading.along = swapped ? LatticeIndex{0, sy} : LatticeIndex{sx, 0};
        reading.up = swapped ? LatticeIndex{sx, 0} : LatticeIndex{0, sy};
        readings.push_back(reading);
      }
  }
  return readings;
}

// Turn of the rotation nearest to a 2x2 matrix of positive determinant.
double TurnOf(const Matrix2d& m) { return std::atan2(m(1, 0) - m(0, 1), m(0, 0) + m(1, 1)); }

double LargestStretch(const Matrix2d& m) { return m.jacobiSvd().singularValues()[0]; }

bool IsInside(const Vector2d& pixel, const PixelRegion& region, double margin_px) {
  return pixel.x() >= region.x + margin_px && pixel.y() >= region.y + margin_px &&
         pixel.x() <= region.x + region.width - 1 - margin_px &&
         pixel.y() <= region.y + region.height - 1 - margin_px;
}

// Whether a place that has no corner, on the grid or one step about it, is out of the view.
bool TouchesEdge(const CornerLattice& lattice, const PixelRegion& region, int beyond) {
  for (int i = lattice.first.first - beyond; i <= lattice.last.first + beyond; ++i)
    for (int j = lattice.first.second - beyond; j <= lattice.last.second + beyond; ++j)
      if (!lattice.pixels.contains({i, j}) &&
          !IsInside(lattice.Predict({i, j}), region, kEdgeMargin_px))
        return true;
  return false;
}

std::string CountOf(const CornerLattice& lattice, const TargetSearch& search) {
  return std::to_string(lattice.Count()) + " of " + std::to_string(search.columns * search.rows);
}

std::string SizeText(int columns, int rows) {
  return std::to_string(columns) + " x " + std::to_string(rows);
}

// A telecentric view shortens one direction of a tilted board and shows the other in full: the
// larger stretch of the axes is the magnification, whatever the pose.
std::string WhyWrongScale(const CornerLattice& lattice, const TargetSearch& search) {
  const double found = LargestStretch(lattice.axes_px);
  const double wanted = LargestStretch(search.nominal_px_per_mm) * search.square_mm;
  if (found > 0.75 * wanted && found < 1.33 * wanted) return {};
  return "another pattern: squares of " + FormatFixed(found, 1) +
         " px where the nominal view has " + FormatFixed(wanted, 1) + " px";
}

}  // namespace

std::string WhyNotWhole(const CornerLattice& lattice, const TargetSearch& search) {
  if (std::string wrong = WhyWrongScale(lattice, search); !wrong.empty()) return wrong;
  const auto [narrow, wide] = std::minmax({lattice.Width(), lattice.Height()});
  const auto [rows, columns] = std::minmax({search.columns, search.rows});
  if (narrow > rows || wide > columns)
    return "another pattern: a grid of " + SizeText(wide, narrow) + " corners, the board has " +
           SizeText(search.columns, search.rows);
  const bool box_is_full = narrow == rows && wide == columns;
  const bool is_complete = box_is_full && lattice.Count() == columns * rows;
  if (is_complete) return {};
  if (TouchesEdge(lattice, search.region, box_is_full ? 0 : 1))
    return "cut off: " + CountOf(lattice, search) + " corners inside the view";
  if (box_is_full && lattice.Filling() >= kLeastFilling) return {};
  return "partly covered: " + CountOf(lattice, search) + " corners found";
}

std::optional<LabelledBoard> LabelBoard(const CornerLattice& lattice, const TargetSearch& search) {
  const Matrix2d nominal_px = search.nominal_px_per_mm * search.square_mm;
  const Reading* best = nullptr;
  LabelledBoard board;
  double least = 10, second = 10;
  const auto readings = Readings(lattice, search.columns, search.rows);
  for (const Reading& reading : readings) {
    const Matrix2d board_from_nominal = nominal_px.inverse() * reading.Axes(lattice);
    if (!(board_from_nominal.determinant() > 0)) continue;
    const double turn = TurnOf(board_from_nominal);
    if (std::abs(turn) < least) {
      second = least;
      least = std::abs(turn);
      best = &reading;
      board.turn_rad = turn;
    } else {
      second = std::min(second, std::abs(turn));
    }
  }
  if (best == nullptr || second - least < kLeastMargin_rad) return std::nullopt;
  board.next_turn_rad = second;
  board.axes_px = best->Axes(lattice);
  for (int row = 0; row < search.rows; ++row)
    for (int column = 0; column < search.columns; ++column) {
      const LatticeIndex at = best->At(column, row);
      const auto seen = lattice.pixels.find(at);
      const bool is_seen = seen != lattice.pixels.end();
      board.corners.push_back({is_seen ? seen->second : lattice.Predict(at), is_seen});
    }
  return board;
}

}  // namespace telestrain
