#include "measurement/point_strain.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

namespace telestrain {
namespace {

constexpr std::size_t kMinNeighbours = 6;

// Index of the used point at every node of one group's grid, -1 where there is none.
class NodeTable {
 public:
  NodeTable(const PipeGrid& grid, const std::vector<PointResult>& points, int group) {
    for (const PipePoint& point : grid.points) {
      if (point.group != group) continue;
      columns_ = std::max(columns_, point.column + 1);
      rows_ = std::max(rows_, point.row + 1);
    }
    nodes_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), -1);
    for (std::size_t i = 0; i < grid.points.size(); ++i)
      if (grid.points[i].group == group && points[i].used)
        nodes_[At(grid.points[i].column, grid.points[i].row)] = static_cast<int>(i);
  }

  std::vector<std::size_t> Around(int column, int row) const {
    std::vector<std::size_t> near;
    for (int r = std::max(0, row - kGaugeReach_steps);
         r <= std::min(rows_ - 1, row + kGaugeReach_steps); ++r)
      for (int c = std::max(0, column - kGaugeReach_steps);
           c <= std::min(columns_ - 1, column + kGaugeReach_steps); ++c)
        if (const int i = nodes_[At(c, r)]; i >= 0) near.push_back(static_cast<std::size_t>(i));
    return near;
  }

 private:
  std::size_t At(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  int columns_ = 0, rows_ = 0;
  std::vector<int> nodes_;
};

// In the middle of the gauge: at the border of the grid that is not the point itself, and the plane
// that touches the surface there would lean against the neighbours' mean one.
Eigen::Matrix3d AxesOfGauge(const PipeShape& shape, const std::vector<DisplacedPoint>& located,
                            const std::vector<std::size_t>& near) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const std::size_t k : near)
    middle += located[k].reference_mm / static_cast<double>(near.size());
  return shape.SurfaceAxes(shape.Straighten(middle));
}

// Columns: slopes along and around of what the neighbours do beyond the field; false when they do
// not determine them.
bool SlopesBeyond(const std::vector<DisplacedPoint>& located, const PatchField& field,
                  const std::vector<std::size_t>& near, const Eigen::Matrix3d& axes,
                  Eigen::Matrix<double, 3, 2>& slopes) {
  const Eigen::Vector3d& origin = located[near.front()].reference_mm;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero(), right = Eigen::Matrix3d::Zero();
  for (const std::size_t k : near) {
    const Eigen::Vector3d offset = located[k].reference_mm - origin;
    const Eigen::Vector3d row(1, axes.col(0).dot(offset), axes.col(1).dot(offset));
    normal += row * row.transpose();
    right += row * (located[k].displacement_mm - field.At(located[k].reference_mm)).transpose();
  }
  const Eigen::LDLT<Eigen::Matrix3d> solver(normal);
  if (!solver.isPositive() || !(solver.rcond() > 1e-9)) return false;
  slopes = solver.solve(right).bottomRows<2>().transpose();
  return true;
}

}  // namespace

void FillPointStrains(const PipeShape& shape, const PipeGrid& grid,
                      const std::vector<DisplacedPoint>& located,
                      const std::vector<PatchFit>& patches, std::vector<PointResult>& points) {
  std::vector<NodeTable> tables;
  for (std::size_t group = 0; group < patches.size(); ++group)
    tables.emplace_back(grid, points, static_cast<int>(group));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].used) continue;
    PointResult& result = points[i];
    result.axial_strain = result.hoop_strain = std::numeric_limits<double>::quiet_NaN();
    const PipePoint& point = grid.points[i];
    const auto group = static_cast<std::size_t>(point.group);
    const std::vector<std::size_t> near = tables[group].Around(point.column, point.row);
    const PatchField& field = patches[group].field;
    if (near.size() < kMinNeighbours) continue;
    const Eigen::Matrix3d axes = AxesOfGauge(shape, located, near);
    Eigen::Matrix<double, 3, 2> slopes;
    if (!SlopesBeyond(located, field, near, axes, slopes)) continue;
    result.tensor = TensorOf(axes.col(0) + field.gradient * axes.col(0) + slopes.col(0),
                             axes.col(1) + field.gradient * axes.col(1) + slopes.col(1));
    result.axial_strain = result.tensor.axial;
    result.hoop_strain = result.tensor.hoop;
  }
}

}  // namespace telestrain
