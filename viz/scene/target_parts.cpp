#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/numbers.h"
#include "viz/scene/scene_colors.h"
#include "viz/scene/scene_parts.h"

namespace telestrain::viz {
namespace {

constexpr double kSquareOpacity = 0.06;  // two dozen boards lie behind each other
constexpr double kEllipsoidOpacity = 0.5, kEllipsoidSquares = 3;

// The dark squares of a board whose first square is dark, from its outline and square size.
Mesh DarkSquares(const Board& board) {
  const Rectangle& outline = board.outline_in_array_mm;
  const Eigen::Vector3d along = outline[1] - outline[0], across = outline[3] - outline[0];
  const double side_mm = board.square_mm;
  if (side_mm <= 0) return Sheet(outline);
  const auto columns = static_cast<int>(std::lround(along.norm() / side_mm));
  const auto rows = static_cast<int>(std::lround(across.norm() / side_mm));
  const auto at = [&](int column, int row) -> Eigen::Vector3d {
    return outline[0] + along * column / columns + across * row / rows;
  };
  Mesh squares;
  for (int row = 0; row < rows; ++row)
    for (int column = row % 2; column < columns; column += 2)
      squares.Append(Sheet(Rectangle{at(column, row), at(column + 1, row), at(column + 1, row + 1),
                                     at(column, row + 1)}));
  return squares;
}

std::vector<Fact> FactsOf(const Board& board) {
  std::vector<Fact> facts{{"image", board.image}, {"group", board.group}};
  if (!board.pose.empty())
    facts.push_back({"pose", board.pose + ", stage " + NumberText(board.stage_mm, 3) + " mm"});
  if (!board.views.empty()) facts.push_back({"residual RMS", FormatFixed(board.rms_px, 4) + " px"});
  for (const BoardView& view : board.views)
    facts.push_back({"view " + view.view, FormatFixed(view.rms_px, 4) + " px over " +
                                              std::to_string(view.corners) + " corners"});
  for (const std::string& reason : board.rejected) facts.push_back({"rejected", reason});
  return facts;
}

Part BoardPart(const Board& board, const ColorMap& colors) {
  Part part;
  part.name = "board " + board.group + " of " + board.image;
  part.layer = Layer::kBoards;
  part.mesh = DarkSquares(board);
  std::vector<Segment> edges = EdgesOf(board.outline_in_array_mm);
  const bool rejected = board.views.empty();
  if (rejected) {
    const Rectangle& corner = board.outline_in_array_mm;
    edges.emplace_back(corner[0], corner[2]);
    edges.emplace_back(corner[1], corner[3]);
  }
  part.mesh.Append(Lines(edges));
  part.color = rejected ? kRejectedColor : colors.At(board.rms_px);
  part.opacity = kSquareOpacity;
  part.line_width_pt = 0.8;
  part.facts = FactsOf(board);
  return part;
}

// Eigenvectors of the covariance times the square roots of its eigenvalues.
Eigen::Matrix3d HalfAxes_mm(const Eigen::Matrix3d& cov_mm2) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(cov_mm2);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

Eigen::Vector3d MiddleOf(const Board& board) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& corner : board.outline_in_array_mm) middle += 0.25 * corner;
  return middle;
}

}  // namespace

std::vector<Part> BoardParts(const Scene& scene, const std::string& group) {
  const ColorMap colors = ResidualColors(scene.boards);
  std::vector<Part> parts;
  for (const Board& board : scene.boards)
    if (group.empty() || board.group == group) parts.push_back(BoardPart(board, colors));
  return parts;
}

double UncertaintyFactor(const Scene& scene) {
  double largest_mm = 0, side_mm = 0;
  for (const Board& board : scene.boards) {
    side_mm = std::max(side_mm, board.square_mm);
    const Eigen::Matrix3d half_axes_mm = HalfAxes_mm(board.cov_center_in_array_mm2);
    largest_mm = std::max(largest_mm, half_axes_mm.colwise().norm().maxCoeff());
  }
  return largest_mm > 0 && side_mm > 0 ? RoundDown(kEllipsoidSquares * side_mm / largest_mm) : 0;
}

std::vector<Part> UncertaintyParts(const Scene& scene, double factor) {
  std::vector<Part> parts;
  if (factor <= 0) return parts;
  const ColorMap colors = ResidualColors(scene.boards);
  for (const Board& board : scene.boards) {
    const Eigen::Matrix3d half_axes_mm = HalfAxes_mm(board.cov_center_in_array_mm2);
    if (board.views.empty() || half_axes_mm.isZero(0)) continue;
    Part part;
    part.name = "uncertainty of board " + board.group + " of " + board.image;
    part.layer = Layer::kUncertainty;
    part.mesh = Ellipsoid(MiddleOf(board), factor * half_axes_mm);
    part.color = colors.At(board.rms_px);
    part.opacity = kEllipsoidOpacity;
    part.lit = true;
    part.facts = {{"image", board.image}, {"group", board.group}};
    const Eigen::Vector3d sigma_um =
        1000 * board.cov_center_in_array_mm2.diagonal().cwiseMax(0).cwiseSqrt();
    for (int i = 0; i < 3; ++i)
      part.facts.push_back({std::string("standard uncertainty ") + "xyz"[i],
                            FormatFixed(sigma_um[i], 3) + " \u00b5m"});
    part.facts.push_back({"drawn", FormatFixed(factor, 0) + " times enlarged"});
    parts.push_back(std::move(part));
  }
  return parts;
}

std::vector<Part> RulerParts(const Scene& scene, double stub_mm) {
  const ColorMap colors = RulerColors(scene.rulers);
  std::vector<Part> parts;
  for (const RulerPosition& ruler : scene.rulers) {
    const auto& [from, to] = ruler.ends_in_array_mm;
    Part part;
    part.name = "ruler of " + ruler.image;
    part.layer = Layer::kRulers;
    const Eigen::Vector3d stub = stub_mm * (to - from).normalized();
    if (stub_mm > 0)
      part.mesh = Lines({{from, from + stub}, {to, to - stub}});
    else
      part.mesh = Lines({{from, to}});
    const bool fails = ruler.verdict == "fail";
    part.color = fails ? kFailColor : colors.At(ruler.error_um);
    part.line_width_pt = fails ? 2.2 : 1;
    part.facts = {{"image", ruler.image},
                  {"length error", NumberText(ruler.error_um, 3) + " \u00b5m"}};
    if (ruler.expanded_uncertainty_um > 0)
      part.facts.push_back(
          {"expanded uncertainty", FormatFixed(ruler.expanded_uncertainty_um, 3) + " \u00b5m"});
    if (!ruler.verdict.empty()) part.facts.push_back({"verdict", ruler.verdict});
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace telestrain::viz
