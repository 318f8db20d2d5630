#include "calibration/array_calibration.h"

#include <algorithm>

#include "base/check.h"
#include "geometry/rotation.h"

namespace telestrain {
namespace {

constexpr std::array<const char*, 5> kCoefficientNames{"k1", "k2", "p1", "p2", "k3"};
constexpr std::array<const char*, 5> kCoefficientUnits{"per_mm2", "per_mm4", "per_mm", "per_mm",
                                                       "per_mm6"};
constexpr int kParametersPerView = 5;

int FreeCount(const DistortionModel& model) {
  return static_cast<int>(std::count(model.begin(), model.end(), true));
}

}  // namespace

std::string ToText(const DistortionModel& model) {
  std::string text;
  for (std::size_t i = 0; i < model.size(); ++i)
    if (model[i]) text += (text.empty() ? "" : " ") + std::string(kCoefficientNames[i]);
  return text.empty() ? "none" : text;
}

int ArrayCalibration::ParameterCount() const {
  return 1 + FreeCount(model) + kParametersPerView * static_cast<int>(views.size());
}

std::vector<std::string> ArrayCalibration::ParameterNames() const {
  std::vector<std::string> names{"magnification_px_per_mm"};
  for (std::size_t i = 0; i < model.size(); ++i)
    if (model[i]) names.push_back(std::string(kCoefficientNames[i]) + "_" + kCoefficientUnits[i]);
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
  moved.lens.magnification_px_per_mm += delta(next++);
  for (std::size_t i = 0; i < model.size(); ++i)
    if (model[i]) moved.lens.distortion[i] += delta(next++);
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
