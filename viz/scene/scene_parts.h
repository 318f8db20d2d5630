#pragma once

#include <array>
#include <string>
#include <vector>

#include "viz/scene/part.h"

namespace telestrain::viz {

// The parts of a scene by kind: what PartsOf puts together and pictures choose from.

// How far the volumes are drawn from their centre towards the camera: a telecentric view has no
// end there; this length only leaves room for the axes and the name.
double StretchOf(const Scene& scene);
// The middle of the camera-side end of the drawn volume.
Eigen::Vector3d TopOf(const Scene& scene, const ViewVolume& view);

// Depth of field (stronger) and stretch towards the camera (fainter) as boxes, the viewing
// direction and the directions of u and v at the first pixel of the region.
std::vector<Part> ViewParts(const Scene& scene);
// The depths of field alone, lightly.
std::vector<Part> FocusParts(const Scene& scene);

// Sensor, mirrors at the size that the light needs and the rays of every view (the paper's
// Fig. 2c); none when the scene has no optics or the rig does not stand up to AnalyseRig.
std::vector<Part> OpticsParts(const Scene& scene);

// Boards as their squares, coloured by the residual RMS on `colors`; what all views rejected is
// grey and crossed out. `group` empty: all.
std::vector<Part> BoardParts(const Scene& scene, const std::string& group = "");
// Ellipsoids of the boards' middles, `factor` times the standard uncertainty.
std::vector<Part> UncertaintyParts(const Scene& scene, double factor);
double UncertaintyFactor(const Scene& scene);

// Rulers as lines in the colour of their error, or only `stub_mm` of either end (0: the whole).
std::vector<Part> RulerParts(const Scene& scene, double stub_mm = 0);

// Along the axis from axis_point_in_array_mm: the measured span, and a little more.
std::array<double, 2> SpanOf(const Pipe& pipe);
std::array<double, 2> DrawnSpanOf(const Pipe& pipe);
// The nominal pipe as a translucent tube; drawn 1 % thinner so that the measured surface covers it.
Part PipePart(const Pipe& pipe, const std::array<double, 2>& span_mm);
// The points on the tube's ends, for cameras.
std::vector<Eigen::Vector3d> OutlineOfPipe(const Pipe& pipe, const std::array<double, 2>& span_mm);
// The measured surface of a state with all its values, a part per group, and their edges.
// `group` < 0: all.
std::vector<Part> SurfaceParts(const Scene& scene, std::size_t state, int group = -1);
std::vector<Eigen::Vector3d> PointsOfGroup(const Surface& surface, int group);
// Arrows on a thinned grid of points; none in a state without displacement.
std::vector<Part> DisplacementParts(const Scene& scene, std::size_t state, double factor);
double DisplacementFactor(const Scene& scene);
std::vector<Part> GaugeParts(const Scene& scene);

// Axes at the array's origin and a scale bar below everything that `extent` holds.
std::vector<Part> FrameParts(const Scene& scene, const std::vector<Eigen::Vector3d>& extent);

// A line along a direction whose length is a round number.
struct ScaleBar {
  Eigen::Vector3d start_in_array_mm;
  Eigen::Vector3d direction;
  double length_mm = 1;
  Eigen::Vector3d End() const { return start_in_array_mm + length_mm * direction; }
};
// In front of everything and below it, `share` of its length along the pipe.
ScaleBar ScaleBarBelow(const std::vector<Eigen::Vector3d>& extent, const SceneAxes& axes,
                       double share);
}  // namespace telestrain::viz
