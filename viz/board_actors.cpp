#include <vtkActor.h>
#include <vtkPolyData.h>

#include <Eigen/Geometry>

#include "viz/actors.h"

namespace telestrain::viz {
namespace {

constexpr double kBoardOpacity = 0.035;  // two dozen lie behind each other

}  // namespace

void AddBoard(vtkRenderer* renderer, const Board& board, const ColorMap& colors, double point_px) {
  const Rgb color = colors.At(board.rms_px);
  AddFlat(renderer, Sheet(board.outline_in_array_mm), color, kBoardOpacity);
  AddLines(renderer, EdgesOf(board.outline_in_array_mm), color, 0.8 * point_px);
}

void AddRulers(vtkRenderer* renderer, const std::vector<RulerPosition>& rulers, double point_px) {
  std::vector<Segment> lines;
  for (const RulerPosition& ruler : rulers)
    lines.emplace_back(ruler.ends_in_array_mm[0], ruler.ends_in_array_mm[1]);
  if (!lines.empty()) AddLines(renderer, lines, kRulerColor, 0.6 * point_px);
}

void AddRulerEnds(vtkRenderer* renderer, const std::vector<RulerPosition>& rulers, double stub_mm,
                  double point_px) {
  std::vector<Segment> lines;
  for (const RulerPosition& ruler : rulers)
    for (const std::size_t end : {0, 1}) {
      const Eigen::Vector3d& from = ruler.ends_in_array_mm[end];
      const Eigen::Vector3d& other = ruler.ends_in_array_mm[1 - end];
      lines.emplace_back(from, from + stub_mm * (other - from).normalized());
    }
  if (!lines.empty()) AddLines(renderer, lines, kRulerColor, 1.0 * point_px);
}

}  // namespace telestrain::viz
