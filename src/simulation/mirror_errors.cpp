#include "simulation/mirror_errors.h"

#include <Eigen/Geometry>

#include "base/check.h"
#include "geometry/rotation.h"

namespace telestrain {

NominalView MisalignMirrors(const Session& drawing, const NominalView& view, double tilt_rad,
                            double shift_mm, RandomStream& random) {
  TELESTRAIN_CHECK(drawing.camera && !view.mirrors.empty(), "a drawing without mirrors");
  NominalView result = view;
  for (Mirror& mirror : result.mirrors) {
    const Eigen::Vector3d across = mirror.normal.unitOrthogonal();
    const double first = random.Uniform(-tilt_rad, tilt_rad);
    const double second = random.Uniform(-tilt_rad, tilt_rad);
    mirror.point_mm += random.Uniform(-shift_mm, shift_mm) * mirror.normal;
    mirror.normal =
        ExpRotation(first * across + second * mirror.normal.cross(across)) * mirror.normal;
  }
  const PhysicalCamera camera = ReflectCamera(*drawing.camera, result.mirrors);
  result.image_x_in_array = camera.image_x;
  result.image_y_in_array = camera.image_y;
  result.axis_in_array = camera.axis;
  const TelecentricView seen = ViewOfCamera(camera);
  const Eigen::Vector2d middle_mm = drawing.NominalLens().IdealFromPixel(view.region.Middle());
  result.center_in_array_mm +=
      seen.axes_in_array.transpose() * (middle_mm - seen.Ideal(view.center_in_array_mm));
  return result;
}

}  // namespace telestrain
