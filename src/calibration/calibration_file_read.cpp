#include <array>
#include <nlohmann/json.hpp>

#include "base/json_file.h"
#include "calibration/calibration_file.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;

// The functions below throw nlohmann::json::exception when a key is missing.
TelecentricLens LensFromJson(const Json& json) {
  TelecentricLens lens;
  lens.magnification_px_per_mm = json.at("magnification_px_per_mm").get<double>();
  lens.aspect = json.at("aspect").get<double>();
  lens.telecentricity_per_mm = json.at("telecentricity_per_mm").get<double>();
  for (int i = 0; i < 2; ++i) lens.center_px(i) = json.at("center_px").at(i).get<double>();
  for (std::size_t i = 0; i < 5; ++i)
    lens.distortion[i] = json.at("distortion").at(kDistortionKeys[i]).get<double>();
  return lens;
}

TelecentricView ViewFromJson(const Json& json, const TelecentricLens& lens) {
  TelecentricView view;
  view.name = json.at("name").get<std::string>();
  view.group = json.at("group").get<std::string>();
  view.depth_sense = json.at("depth_sense").get<double>();
  view.depth_offset_mm = json.at("depth_offset_mm").get<double>();
  for (int i = 0; i < 3; ++i) {
    view.axes_in_array(0, i) = json.at("image_x_in_array").at(i).get<double>();
    view.axes_in_array(1, i) = json.at("image_y_in_array").at(i).get<double>();
  }
  for (int i = 0; i < 2; ++i)
    view.offset_mm(i) =
        (json.at("offset_px").at(i).get<double>() - lens.center_px(i)) / lens.Scales_px_per_mm()(i);
  return view;
}

LensModel ModelFromJson(const Json& json) {
  LensModel model;
  model.distortion = json.at("distortion").get<std::array<bool, 5>>();
  model.aspect = json.at("aspect").get<bool>();
  model.telecentricity = json.at("telecentricity").get<bool>();
  model.per_view = json.at("per_view").get<bool>();
  return model;
}

Eigen::MatrixXd MatrixFromJson(const Json& rows, int size) {
  Eigen::MatrixXd matrix(size, size);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) matrix(i, j) = rows.at(i).at(j).get<double>();
  return matrix;
}

ArrayCalibration ArrayFromJson(const Json& json) {
  ArrayCalibration array;
  array.model = ModelFromJson(json.at("lens").at("estimated"));
  if (!array.model.per_view) array.lenses.push_back(LensFromJson(json.at("lens")));
  for (const Json& view : json.at("views")) {
    if (array.model.per_view) array.lenses.push_back(LensFromJson(view.at("lens")));
    array.views.push_back(ViewFromJson(view, array.lenses.back()));
  }
  const Json& covariance = json.at("covariance");
  array.covariance = MatrixFromJson(covariance.at("matrix"), array.ParameterCount());
  array.covariance_of_noise =
      MatrixFromJson(covariance.at("matrix_of_noise"), array.ParameterCount());
  return array;
}

}  // namespace

Result<ArrayCalibration> ReadArrayCalibration(const std::filesystem::path& path) {
  TELESTRAIN_ASSIGN_OR_RETURN(const Json json,
                              ReadJson(path, kCalibrationSchema, "telestrain calibrate"));
  try {
    return ArrayFromJson(json);
  } catch (const nlohmann::json::exception& e) {
    return BadInput(path.string() + ": " + JsonProblem(e) +
                    "; make the file again with 'telestrain calibrate'");
  }
}

}  // namespace telestrain
