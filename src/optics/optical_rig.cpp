#include "optics/optical_rig.h"

namespace telestrain {

PhysicalCamera VirtualCamera(const OpticalRig& rig, const OpticalPath& path) {
  return ReflectCamera(rig.camera, path.mirrors);
}

double FocusPath_mm(const OpticalRig& rig, const OpticalPath& path) {
  const PhysicalCamera camera = VirtualCamera(rig, path);
  return camera.axis.dot(path.center_in_array_mm - camera.position_mm);
}

}  // namespace telestrain
