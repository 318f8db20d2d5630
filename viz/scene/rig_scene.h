#pragma once

#include "optics/rig_design.h"
#include "viz/scene/part.h"

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

// Where a rig's sensor is drawn: the axis coordinate from camera.position_mm. It stands in front of
// the first mirrors at object scale, wherever the camera's reference point is: a telecentric path
// has no length before the mirrors.
double SensorPlane_mm(const OpticalRig& rig, const RigDesign& design);

// The sensor's parts and its frame; mirrors with a rim in the colour of their view; of every view
// the middle ray thick and the corner rays thin.
std::vector<Part> SensorParts(const OpticalRig& rig, const Scene& scene, double sensor_mm);
std::vector<Part> MirrorParts(const RigDesign& design, const Scene& scene);
std::vector<Part> RayParts(const OpticalRig& rig, const RigDesign& design, const Scene& scene,
                           double sensor_mm);

}  // namespace telestrain::viz
