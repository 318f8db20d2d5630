#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "viz/canvas.h"
#include "viz/scene/color_map.h"
#include "viz/scene/scene.h"
#include "viz/solids.h"

class vtkRenderer;

namespace telestrain::viz {

// The parts of a scene as VTK actors. `point_px` is the size of 1/72 inch, for line widths.

// One colour per group of views, a lighter one for every second view of the group. The colours are
// those of M. Okabe and K. Ito (2008), told apart with any colour vision.
Rgb ColorOfGroup(const Scene& scene, const std::string& group);
Rgb ColorOfView(const Scene& scene, std::size_t view);
inline constexpr Rgb kImageXColor{0.80, 0.10, 0.12};
inline constexpr Rgb kImageYColor{0.10, 0.52, 0.20};
inline constexpr Rgb kRulerColor{0.00, 0.45, 0.36};
inline constexpr Rgb kPipeColor{0.55, 0.60, 0.66};
inline constexpr Rgb kInk{0.13, 0.15, 0.18};

// How far the volumes are drawn from their centre towards the camera: a telecentric view has no
// end there; this length only leaves room for the axes and the name.
double StretchOf(const Scene& scene);

// Depth of field (stronger) and stretch towards the camera (fainter) as boxes, the viewing
// direction and the directions of u and v at the first pixel of the region.
void AddViewVolume(vtkRenderer* renderer, const Scene& scene, std::size_t view, double point_px);
// The middle of the camera-side end of the drawn box.
Eigen::Vector3d TopOf(const Scene& scene, const ViewVolume& view);

// A translucent sheet with an outline, both in the colour of its residual.
void AddBoard(vtkRenderer* renderer, const Board& board, const ColorMap& colors, double point_px);

// The rulers as lines, or only `stub_mm` of either end.
void AddRulers(vtkRenderer* renderer, const std::vector<RulerPosition>& rulers, double point_px);
void AddRulerEnds(vtkRenderer* renderer, const std::vector<RulerPosition>& rulers, double stub_mm,
                  double point_px);

// The fitted pipe as a translucent tube between two positions along its axis; its radius is drawn
// 1 % short so that the measured surface covers it.
void AddNominalPipe(vtkRenderer* renderer, const Pipe& pipe, const std::array<double, 2>& span_mm,
                    double point_px);
// The measured surface without light: its colours are those of the bar. `group` < 0 draws all.
void AddStrainSurface(vtkRenderer* renderer, const Surface& surface, const ColorMap& colors,
                      int group = -1);

// The edge of a group's patch as a thin dark line.
void AddPatchEdge(vtkRenderer* renderer, const Surface& surface, int group, double point_px);

// From the smallest to the largest position of surface points along the pipe's axis.
std::array<double, 2> SpanOf(const Pipe& pipe);
std::vector<Eigen::Vector3d> PointsOfGroup(const Surface& surface, int group);
// The points on the tube's ends, for cameras.
std::vector<Eigen::Vector3d> OutlineOfPipe(const Pipe& pipe, const std::array<double, 2>& span_mm);
// The measured span and a little more.
std::array<double, 2> DrawnSpanOf(const Pipe& pipe);

// A line along a direction whose length is a round number.
struct ScaleBar {
  Eigen::Vector3d start_in_array_mm;
  Eigen::Vector3d direction;
  double length_mm = 1;
  Eigen::Vector3d End() const { return start_in_array_mm + length_mm * direction; }
};
// 1, 2 or 5 times a power of ten, the largest not above `length`.
double RoundLength(double length);
void AddScaleBar(Canvas* canvas, const std::string& panel, vtkRenderer* renderer,
                 const ScaleBar& bar);

// The array frame's axes in a small panel of their own, turned as the camera of the scene is.
void AddTriad(Canvas* canvas, const SceneAxes& axes, const ViewDirection& direction,
              const PixelBox& box);

}  // namespace telestrain::viz
