#pragma once

#include "optics/rig_design.h"
#include "viz/scene/scene.h"
#include "viz/solids.h"

class vtkRenderer;

namespace telestrain::viz {

// A rig as a scene of views and a nominal pipe (without pairs or a diameter: no pipe), so that
// colours and axes are those of the other pictures.
Scene SceneOfRig(const OpticalRig& rig, const RigDesign& design);

// A part of the sensor in the plane `along_mm` behind camera.position_mm, at object scale.
Rectangle SensorPart(const OpticalRig& rig, const Eigen::AlignedBox2d& field_mm, double along_mm);
// The rectangle about all fields.
Eigen::AlignedBox2d WholeField(const OpticalRig& rig);

// Corners of a traced ray from the sensor's plane on.
std::vector<Eigen::Vector3d> DrawnRay(const TracedRay& ray, const OpticalRig& rig,
                                      double sensor_mm);

void AddSensor(vtkRenderer* renderer, const OpticalRig& rig, const Scene& scene, double sensor_mm,
               double point_px);
// Mirrors with a rim in the colour of their view.
void AddMirrors(vtkRenderer* renderer, const RigDesign& design, const Scene& scene,
                double point_px);
// The middle ray thick, the corner rays thin.
void AddRays(vtkRenderer* renderer, const OpticalRig& rig, const RigDesign& design,
             const Scene& scene, double sensor_mm, double point_px);
// The space that is in focus, per view.
void AddFocusBoxes(vtkRenderer* renderer, const Scene& scene, double point_px);

inline constexpr Rgb kMirrorColor{0.62, 0.68, 0.74};
inline constexpr Rgb kSensorColor{0.30, 0.33, 0.37};

}  // namespace telestrain::viz
