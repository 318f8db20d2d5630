#include "calibration/calibration_file.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/csv.h"
#include "base/json_file.h"
#include "base/numbers.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 5> kDistortionKeys{"k1_per_mm2", "k2_per_mm4", "p1_per_mm",
                                                     "p2_per_mm", "k3_per_mm6"};

template <typename Derived>
Json ArrayOf(const Eigen::MatrixBase<Derived>& values) {
  Json array = Json::array();
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index j = 0; j < values.cols(); ++j) array.push_back(values(i, j));
  return array;
}

Json LensJson(const Calibration& calibration) {
  const ArrayCalibration& array = calibration.bundle.state.array;
  Json distortion;
  for (std::size_t i = 0; i < 5; ++i) distortion[kDistortionKeys[i]] = array.lens.distortion[i];
  return {{"magnification_px_per_mm", array.lens.magnification_px_per_mm},
          {"sigma_magnification_px_per_mm", std::sqrt(array.covariance(0, 0))},
          {"seed_magnification_px_per_mm", calibration.seed.lens.magnification_px_per_mm},
          {"object_side_um_per_px", 1000.0 / array.lens.magnification_px_per_mm},
          {"center_px", ArrayOf(array.lens.center_px)},
          {"model", ToText(array.model)},
          {"distortion", distortion}};
}

Json ViewJson(const Session& session, const Calibration& calibration, std::size_t i) {
  const ArrayCalibration& array = calibration.bundle.state.array;
  const TelecentricView& view = array.views[i];
  const NominalView& nominal = session.views[i];
  const ReprojectionStatistics& statistics = calibration.of_view[i];
  const Eigen::Matrix3d rotation = view.Rotation();
  // The ray direction is known up to its sign; the nominal view says which end is the camera's.
  const double sense = rotation.row(2).dot(nominal.axis_in_array) >= 0 ? 1.0 : -1.0;
  const Eigen::Vector3d axis = sense * rotation.row(2).transpose();
  const Eigen::Vector2d ideal = array.lens.IdealFromPixel(nominal.region.Middle());
  Eigen::Vector3d center = view.PointOnRay(ideal);
  center += axis * axis.dot(nominal.center_in_array_mm - center);
  const auto& region = nominal.region;
  const auto& paper = calibration.seed.view_magnifications_of_paper[i];
  return {{"name", view.name},
          {"group", view.group},
          {"region_px", {region.x, region.y, region.width, region.height}},
          {"image_x_in_array", ArrayOf(rotation.row(0))},
          {"image_y_in_array", ArrayOf(rotation.row(1))},
          {"axis_in_array", ArrayOf(axis)},
          {"offset_px",
           ArrayOf(array.lens.center_px + array.lens.magnification_px_per_mm * view.offset_mm)},
          {"center_in_array_mm", ArrayOf(center)},
          {"depth_of_field_mm", session.depth_of_field_mm},
          {"seed_magnification_px_per_mm", calibration.seed.view_magnification_px_per_mm[i]},
          {"magnification_eq6_px_per_mm", paper ? ArrayOf(*paper) : Json(nullptr)},
          {"rms_px", statistics.rms_px},
          {"mean_px", statistics.mean_px},
          {"max_px", statistics.max_px},
          {"corners", statistics.corners}};
}

Json PosesJson(const Session& session, const Calibration& calibration) {
  Json poses = Json::array();
  const CalibrationData& data = calibration.data;
  for (std::size_t k = 0; k < data.images.size(); ++k) {
    const TargetPose& pose = calibration.bundle.state.poses[k];
    Json boards = Json::array();
    for (std::size_t b = 0; b < data.boards.size(); ++b) {
      if (data.boards[b].image != static_cast<int>(k)) continue;
      const ReprojectionStatistics& statistics = calibration.of_board[b];
      boards.push_back({{"view", session.views[static_cast<std::size_t>(data.boards[b].view)].name},
                        {"rms_px", statistics.rms_px},
                        {"max_px", statistics.max_px},
                        {"corners", statistics.corners}});
    }
    poses.push_back({{"image", data.images[k].image},
                     {"pose", data.images[k].pose},
                     {"stage_mm", data.images[k].stage_mm},
                     {"rotation_array_from_target", ArrayOf(pose.array_from_target)},
                     {"origin_in_array_mm", ArrayOf(pose.origin_in_array_mm)},
                     {"boards", boards}});
  }
  return poses;
}

// Counts of the scalar errors in bins of a fifth of their RMS, out to four times the RMS.
Json HistogramJson(const Calibration& calibration) {
  constexpr int kBins = 40;
  const double bin_px = calibration.all.rms_px / 5;
  std::vector<int> counts(kBins, 0);
  int outside = 0;
  for (const BoardData& board : calibration.data.boards) {
    const Eigen::Matrix2Xd errors = ReprojectionErrors_px(calibration.bundle.state, board);
    for (Eigen::Index i = 0; i < errors.size(); ++i) {
      const double at = bin_px > 0 ? errors.data()[i] / bin_px + kBins / 2.0 : kBins / 2.0;
      if (at >= 0 && at < kBins)
        ++counts[static_cast<std::size_t>(at)];
      else
        ++outside;
    }
  }
  return {{"bin_px", bin_px},
          {"from_px", -bin_px * kBins / 2},
          {"counts", counts},
          {"outside", outside}};
}

Json ReprojectionJson(const Calibration& calibration, int boards_rejected) {
  return {{"rms_px", calibration.all.rms_px},
          {"mean_px", calibration.all.mean_px},
          {"max_px", calibration.all.max_px},
          {"expected_rms_px", calibration.expected_rms_px},
          {"sigma0", calibration.sigma0},
          {"corners_used", calibration.all.corners},
          {"corners_rejected", calibration.corners_rejected},
          {"boards_used", calibration.data.boards.size()},
          {"boards_rejected", boards_rejected},
          {"histogram", HistogramJson(calibration)}};
}

Json StageJson(const Calibration& calibration) {
  const AmbiguityDecision& decision = calibration.seed.decision;
  return {{"boards", decision.boards},
          {"nominal_margin_deg", decision.smallest_nominal_margin_deg},
          {"pairs", decision.stage_pairs},
          {"agreeing", decision.stage_agreeing},
          {"margin_px", decision.smallest_stage_margin_px},
          {"nominal_agrees", decision.stage_agreeing == decision.stage_pairs},
          {"axis_in_array", ArrayOf(calibration.bundle.state.stage_axis_in_array)},
          {"axis_to_nominal_deg", calibration.stage.axis_to_nominal_deg},
          {"rms_travel_error_um", calibration.stage.rms_travel_error_um},
          {"twin_cost_ratio", calibration.stage.twin_chi2_ratio}};
}

Json ModelTestsJson(const Calibration& calibration) {
  Json tests = Json::array();
  for (const ModelTest& test : calibration.model_tests)
    tests.push_back({{"model", ToText(test.model)},
                     {"parameters", test.added_parameters},
                     {"chi2", test.chi2},
                     {"f_statistic", test.f_statistic},
                     {"p_value", test.p_value},
                     {"accepted", test.accepted}});
  return tests;
}

Json GaugeJson(const Session& session, const Calibration& calibration) {
  const std::string& image =
      calibration.data.images[static_cast<std::size_t>(calibration.bundle.gauge_pose)].image;
  Json gauge = Json::array();
  gauge.push_back("array frame: fitted rigidly to the nominal views, then the target pose of " +
                  image + " is held fixed (6 parameters)");
  gauge.push_back("principal point: fixed at the middle of the sensor (" +
                  FormatShortest(session.sensor.Middle().x()) + ", " +
                  FormatShortest(session.sensor.Middle().y()) + ") px; it is not observable");
  gauge.push_back("position of every view along its axis: does not exist for parallel rays");
  gauge.push_back("aspect ratio: fixed at 1; scale: from the certified corner pitch");
  return gauge;
}

}  // namespace

nlohmann::ordered_json CalibrationJson(const Session& session, const Calibration& calibration,
                                       const std::map<std::string, std::string>& made_from) {
  const ArrayCalibration& array = calibration.bundle.state.array;
  Json views = Json::array();
  for (std::size_t i = 0; i < array.views.size(); ++i)
    views.push_back(ViewJson(session, calibration, i));
  Json rejected = Json::array();
  int boards_rejected = 0;
  for (const RejectedObservation& r : calibration.data.rejected) {
    rejected.push_back({{"image", r.image},
                        {"view", r.view},
                        {"reason", r.reason},
                        {"corners", r.corners},
                        {"whole_board", r.whole_board}});
    if (r.whole_board) ++boards_rejected;
  }
  Json covariance = Json::array();
  for (Eigen::Index i = 0; i < array.covariance.rows(); ++i)
    covariance.push_back(ArrayOf(array.covariance.row(i)));
  return {
      {"schema", kCalibrationSchema},
      {"made_from", made_from},
      {"sensor", {{"width_px", session.sensor.width_px}, {"height_px", session.sensor.height_px}}},
      {"lens", LensJson(calibration)},
      {"views", views},
      {"reprojection", ReprojectionJson(calibration, boards_rejected)},
      {"stage_decision", StageJson(calibration)},
      {"model_tests", ModelTestsJson(calibration)},
      {"gauge", GaugeJson(session, calibration)},
      {"solver",
       {{"residuals", calibration.bundle.residual_count},
        {"parameters", calibration.bundle.parameter_count},
        {"chi2", calibration.bundle.chi2}}},
      {"poses", PosesJson(session, calibration)},
      {"rejected", rejected},
      {"covariance", {{"parameters", array.ParameterNames()}, {"matrix", covariance}}}};
}

std::string ResidualsCsv(const Session& session, const Calibration& calibration) {
  std::string text = "image,view,column,row,u_px,v_px,du_px,dv_px\n";
  for (const BoardData& board : calibration.data.boards) {
    const Eigen::Matrix2Xd errors = ReprojectionErrors_px(calibration.bundle.state, board);
    for (Eigen::Index i = 0; i < board.Count(); ++i) {
      const int corner = board.corner[static_cast<std::size_t>(i)];
      text += CsvLine({calibration.data.images[static_cast<std::size_t>(board.image)].image,
                       session.views[static_cast<std::size_t>(board.view)].name,
                       std::to_string(corner % session.target.columns),
                       std::to_string(corner / session.target.columns),
                       FormatFixed(board.pixels(0, i), 4), FormatFixed(board.pixels(1, i), 4),
                       FormatFixed(errors(0, i), 6), FormatFixed(errors(1, i), 6)});
    }
  }
  return text;
}

Result<ArrayCalibration> ReadArrayCalibration(const std::filesystem::path& path) {
  TELESTRAIN_ASSIGN_OR_RETURN(const Json json,
                              ReadJson(path, kCalibrationSchema, "telestrain calibrate"));
  try {
    ArrayCalibration array;
    const Json& lens = json.at("lens");
    array.lens.magnification_px_per_mm = lens.at("magnification_px_per_mm").get<double>();
    for (int i = 0; i < 2; ++i) array.lens.center_px(i) = lens.at("center_px").at(i).get<double>();
    for (std::size_t i = 0; i < 5; ++i)
      array.lens.distortion[i] = lens.at("distortion").at(kDistortionKeys[i]).get<double>();
    const std::string model = lens.at("model").get<std::string>();
    for (std::size_t i = 0; i < 5; ++i)
      array.model[i] =
          model.find(std::string(kDistortionKeys[i]).substr(0, 2)) != std::string::npos;
    for (const Json& view : json.at("views")) {
      TelecentricView read;
      read.name = view.at("name").get<std::string>();
      read.group = view.at("group").get<std::string>();
      for (int i = 0; i < 3; ++i) {
        read.axes_in_array(0, i) = view.at("image_x_in_array").at(i).get<double>();
        read.axes_in_array(1, i) = view.at("image_y_in_array").at(i).get<double>();
      }
      for (int i = 0; i < 2; ++i)
        read.offset_mm(i) = (view.at("offset_px").at(i).get<double>() - array.lens.center_px(i)) /
                            array.lens.magnification_px_per_mm;
      array.views.push_back(std::move(read));
    }
    const Json& matrix = json.at("covariance").at("matrix");
    const int size = array.ParameterCount();
    array.covariance.resize(size, size);
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j) array.covariance(i, j) = matrix.at(i).at(j).get<double>();
    return array;
  } catch (const nlohmann::json::exception& e) {
    return BadInput(path.string() + ": " + e.what() +
                    "; make the file again with 'telestrain calibrate'");
  }
}

}  // namespace telestrain
