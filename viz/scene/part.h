#pragma once

#include <string>
#include <vector>

#include "viz/scene/color_map.h"
#include "viz/scene/mesh.h"
#include "viz/scene/scene.h"

namespace telestrain::viz {

// What can be shown and hidden together.
enum class Layer {
  kViews,
  kBoards,
  kRulers,
  kPipe,
  kSurface,
  kDisplacements,
  kGauges,
  kUncertainty,
  kFrame,
  kOptics
};
inline constexpr Layer kAllLayers[] = {
    Layer::kViews,         Layer::kBoards, Layer::kRulers,      Layer::kPipe,  Layer::kSurface,
    Layer::kDisplacements, Layer::kGauges, Layer::kUncertainty, Layer::kFrame, Layer::kOptics};
// "views", "optics", …: the word in flags, pages and files.
std::string NameOf(Layer layer);

// What a click on a part tells: "residual RMS", "0.0019 px".
struct Fact {
  std::string name, value;
};

inline constexpr int kEveryState = -1;

// One drawable piece of a scene, free of any graphics library: what the renderer, the page, the
// desk program and the export formats all get.
struct Part {
  std::string name;  // unique among the parts: "view A1, depth of field"
  Layer layer = Layer::kViews;
  int state = kEveryState;  // index of the only pipe state that shows it
  Mesh mesh;
  Rgb color;                   // of faces and lines without values
  double opacity = 1;          // of the faces; lines are opaque
  double line_width_pt = 0.6;  // 1/72 inch on paper
  bool lit = false;            // faces shaded by their slope; else exactly the colour
  // Per point of the mesh. When a part has values, the quantity that is looked at colours it.
  std::vector<PointValues> values;
  std::vector<Fact> facts;
};

// What PartsOf makes of a scene.
struct PartChoices {
  // Drawn displacement / true displacement. 0: the largest round factor with which no arrow is
  // longer than a tenth of the base length.
  double displacement_factor = 0;
  // Drawn half axis / standard uncertainty. 0: the largest round factor with which no half axis is
  // longer than three squares of its board.
  double uncertainty_factor = 0;
};

struct PartList {
  std::vector<Part> parts;
  double displacement_factor = 1, uncertainty_factor = 1;  // as drawn
};

// All parts of a scene, in the order of kAllLayers; the same scene gives the same parts.
PartList PartsOf(const Scene& scene, const PartChoices& choices = {});

// The points of all parts, for cameras.
std::vector<Eigen::Vector3d> PointsOf(const std::vector<Part>& parts);

}  // namespace telestrain::viz
