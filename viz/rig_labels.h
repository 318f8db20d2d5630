#pragma once

#include <string>

#include "viz/canvas.h"
#include "viz/scene/rig_scene.h"

namespace telestrain::viz {

// What every panel of a rig shows.
struct RigDrawing {
  const OpticalRig& rig;
  const RigDesign& design;
  Scene scene;
  double sensor_mm;  // SensorPlane_mm
  std::array<double, 2> pipe_span_mm;
};

// A name beside every mirror, one for those that lie behind one another in the panel.
void NameMirrors(Canvas* canvas, const std::string& panel, const RigDrawing& drawing);
void NameSensor(Canvas* canvas, const std::string& panel, const RigDrawing& drawing);

}  // namespace telestrain::viz
