#include "calibration/array_calibration.h"

#include <algorithm>

#include "base/check.h"
#include "geometry/rotation.h"

namespace telestrain {
namespace {

constexpr int kParametersPerView = 5;

// The estimated parameters of a lens, in the order of the covariance.
struct LensParameter {
  const char* name;
  bool free;
  double* value;
};

std::vector<LensParameter> FreeParameters(const LensModel& model, TelecentricLens& lens) {
  auto& [k1, k2, p1, p2, k3] = lens.distortion;
  const auto& free = model.distortion;
  std::vector<LensParameter> parameters{
      {"magnification_px_per_mm", true, &lens.magnification_px_per_mm},
      {"aspect", model.aspect, &lens.aspect},
      {"k1_per_mm2", free[0], &k1},
      {"k2_per_mm4", free[1], &k2},
      {"p1_per_mm", free[2], &p1},
      {"p2_per_mm", free[3], &p2},
      {"k3_per_mm6", free[4], &k3},
      {"telecentricity_per_mm", model.telecentricity, &lens.telecentricity_per_mm}};
  std::erase_if(parameters, [](const LensParameter& p) { return !p.free; });
  return parameters;
}

}  // namespace

int LensModel::Count() const {
  TelecentricLens lens;
  return static_cast<int>(FreeParameters(*this, lens).size());
}

std::string ToText(const LensModel& model) {
  TelecentricLens lens;
  std::string text;
  for (const LensParameter& parameter : FreeParameters(model, lens)) {
    if (parameter.value == &lens.magnification_px_per_mm) continue;
    const std::string name = parameter.name;
    text += (text.empty() ? "" : " ") + name.substr(0, name.find('_'));
  }
  if (text.empty()) text = "none";
  return model.per_view ? text + ", a lens per view" : text;
}

Eigen::Vector2d ArrayCalibration::Project(int view,
                                          const Eigen::Vector3d& point_in_array_mm) const {
  const auto index = static_cast<std::size_t>(view);
  return telestrain::Project(LensOf(index), views[index], point_in_array_mm);
}

ImageRay ArrayCalibration::RayOf(int view, const Eigen::Vector2d& pixel) const {
  const auto index = static_cast<std::size_t>(view);
  return RayOfPixel(LensOf(index), views[index], pixel);
}

double ArrayCalibration::Magnification_px_per_mm() const {
  double sum = 0;
  for (const TelecentricLens& lens : lenses) sum += lens.magnification_px_per_mm;
  return sum / static_cast<double>(lenses.size());
}

int ArrayCalibration::ParameterCount() const {
  return model.Count() * static_cast<int>(lenses.size()) +
         kParametersPerView * static_cast<int>(views.size());
}

std::vector<std::string> ArrayCalibration::ParameterNames() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < lenses.size(); ++i) {
    TelecentricLens lens;
    const std::string prefix = lenses.size() == 1 ? "" : views[i].name + ".";
    for (const LensParameter& parameter : FreeParameters(model, lens))
      names.push_back(prefix + parameter.name);
  }
  for (const TelecentricView& view : views)
    for (const char* what :
         {"rotation_x_rad", "rotation_y_rad", "rotation_z_rad", "offset_x_mm", "offset_y_mm"})
      names.push_back(view.name + "." + what);
  return names;
}

ArrayCalibration ArrayCalibration::Perturbed(const Eigen::VectorXd& delta) const {
  TELESTRAIN_CHECK(delta.size() == ParameterCount(), "wrong number of parameters");
  ArrayCalibration moved = *this;
  Eigen::Index next = 0;
  for (TelecentricLens& lens : moved.lenses)
    for (const LensParameter& parameter : FreeParameters(model, lens))
      *parameter.value += delta(next++);
  for (TelecentricView& view : moved.views) {
    view.axes_in_array = (ExpRotation(delta.segment<3>(next)) * view.Rotation()).topRows<2>();
    view.offset_mm += delta.segment<2>(next + 3);
    next += kParametersPerView;
  }
  return moved;
}

const TelecentricView* ArrayCalibration::FindView(const std::string& name) const {
  for (const TelecentricView& view : views)
    if (view.name == name) return &view;
  return nullptr;
}

}  // namespace telestrain
