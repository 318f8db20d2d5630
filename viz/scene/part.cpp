#include "viz/scene/part.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/numbers.h"
#include "viz/scene/scene_colors.h"
#include "viz/scene/scene_parts.h"

namespace telestrain::viz {
namespace {

void AddTo(std::vector<Part>* parts, std::vector<Part> more) {
  for (Part& part : more) parts->push_back(std::move(part));
}

void AddPipe(const Scene& scene, double displacement_factor, std::vector<Part>* parts) {
  parts->push_back(PipePart(*scene.pipe, DrawnSpanOf(*scene.pipe)));
  for (std::size_t i = 0; i < scene.pipe->states.size(); ++i) AddTo(parts, SurfaceParts(scene, i));
  for (std::size_t i = 0; i < scene.pipe->states.size(); ++i)
    AddTo(parts, DisplacementParts(scene, i, displacement_factor));
  AddTo(parts, GaugeParts(scene));
}

}  // namespace

std::string NameOf(Layer layer) {
  switch (layer) {
    case Layer::kViews:
      return "views";
    case Layer::kOptics:
      return "optics";
    case Layer::kBoards:
      return "boards";
    case Layer::kRulers:
      return "rulers";
    case Layer::kPipe:
      return "pipe";
    case Layer::kSurface:
      return "surface";
    case Layer::kDisplacements:
      return "displacements";
    case Layer::kGauges:
      return "gauges";
    case Layer::kUncertainty:
      return "uncertainty";
    case Layer::kFrame:
      break;
  }
  return "frame";
}

PartList PartsOf(const Scene& scene, const PartChoices& choices) {
  PartList list;
  list.displacement_factor =
      choices.displacement_factor > 0 ? choices.displacement_factor : DisplacementFactor(scene);
  list.uncertainty_factor =
      choices.uncertainty_factor > 0 ? choices.uncertainty_factor : UncertaintyFactor(scene);
  AddTo(&list.parts, ViewParts(scene));
  AddTo(&list.parts, BoardParts(scene));
  AddTo(&list.parts, RulerParts(scene));
  if (scene.pipe && !scene.pipe->states.empty())
    AddPipe(scene, list.displacement_factor, &list.parts);
  AddTo(&list.parts, UncertaintyParts(scene, list.uncertainty_factor));
  AddTo(&list.parts, FrameParts(scene, PointsOf(list.parts)));
  AddTo(&list.parts, OpticsParts(scene));
  return list;
}

std::vector<Eigen::Vector3d> PointsOf(const std::vector<Part>& parts) {
  std::vector<Eigen::Vector3d> points;
  for (const Part& part : parts)
    points.insert(points.end(), part.mesh.points_in_array_mm.begin(),
                  part.mesh.points_in_array_mm.end());
  return points;
}

ScaleBar ScaleBarBelow(const std::vector<Eigen::Vector3d>& extent, const SceneAxes& axes,
                       double share) {
  Eigen::Matrix3d from_array;
  from_array << axes.along.transpose(), axes.across.transpose(), axes.up.transpose();
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& point : extent) bounds.extend(Eigen::Vector3d(from_array * point));
  const Eigen::Vector3d start(bounds.min().x(), 0.6 * bounds.min().y(), bounds.min().z());
  return {from_array.transpose() * start, axes.along, RoundDown(share * bounds.sizes().x())};
}

std::vector<Part> FrameParts(const Scene& scene, const std::vector<Eigen::Vector3d>& extent) {
  std::vector<Part> parts;
  if (extent.empty()) return parts;
  const ScaleBar bar = ScaleBarBelow(extent, AxesOf(scene), 0.3);
  Part scale;
  scale.name = "scale bar";
  scale.layer = Layer::kFrame;
  scale.mesh = Lines({{bar.start_in_array_mm, bar.End()}});
  scale.color = kInk;
  scale.line_width_pt = 1.8;
  scale.facts = {{"length", FormatShortest(bar.length_mm) + " mm"}};
  parts.push_back(scale);
  for (int i = 0; i < 3; ++i) {
    Part axis;
    axis.name = std::string("array axis ") + "xyz"[i];
    axis.layer = Layer::kFrame;
    axis.mesh = Arrow({Eigen::Vector3d::Zero(), 0.3 * bar.length_mm * Eigen::Vector3d::Unit(i)},
                      0.018 * bar.length_mm);
    axis.color = kAxisColors[i];
    axis.lit = true;
    parts.push_back(axis);
  }
  return parts;
}

}  // namespace telestrain::viz
