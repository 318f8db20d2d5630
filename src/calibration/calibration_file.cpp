#include "calibration/calibration_file.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/csv.h"
#include "base/json_file.h"
#include "base/numbers.h"
#include "calibration/calibration_json.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;

// A square matrix as an array of rows.
Json RowsOf(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) rows.push_back(ArrayOf(matrix.row(i)));
  return rows;
}

Json LensParametersJson(const TelecentricLens& lens) {
  Json distortion;
  for (std::size_t i = 0; i < 5; ++i) distortion[kDistortionKeys[i]] = lens.distortion[i];
  return {{"magnification_px_per_mm", lens.magnification_px_per_mm},
          {"center_px", ArrayOf(lens.center_px)},
          {"aspect", lens.aspect},
          {"telecentricity_per_mm", lens.telecentricity_per_mm},
          {"distortion", distortion}};
}

// Of the lens's magnification, or of the mean over the lenses.
double SigmaOfMagnification(const ArrayCalibration& array) {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(array.covariance.rows());
  const auto lenses = static_cast<Eigen::Index>(array.lenses.size());
  for (Eigen::Index i = 0; i < lenses; ++i)
    gradient(i * array.model.Count()) = 1.0 / static_cast<double>(lenses);
  return std::sqrt(gradient.dot(array.covariance * gradient));
}

// The lens of all views; with a lens per view the first one, and the mean magnification.
Json LensJson(const Calibration& calibration) {
  const ArrayCalibration& array = calibration.bundle.state.array;
  Json json = LensParametersJson(array.lenses.front());
  json["magnification_px_per_mm"] = array.Magnification_px_per_mm();
  json["sigma_magnification_px_per_mm"] = SigmaOfMagnification(array);
  json["seed_magnification_px_per_mm"] = calibration.seed.lens.magnification_px_per_mm;
  json["object_side_um_per_px"] = 1000.0 / array.Magnification_px_per_mm();
  json["model"] = ToText(array.model);
  json["estimated"] = {{"distortion", array.model.distortion},
                       {"aspect", array.model.aspect},
                       {"telecentricity", array.model.telecentricity},
                       {"per_view", array.model.per_view}};
  json["distortion_direction"] = "ideal to observed";
  return json;
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
  const TelecentricLens& lens = array.LensOf(i);
  const Eigen::Vector2d ideal = lens.IdealFromPixel(nominal.region.Middle());
  Eigen::Vector3d center = view.PointOnRay(ideal);
  center += axis * axis.dot(nominal.center_in_array_mm - center);
  const auto& region = nominal.region;
  const auto& paper = calibration.seed.view_magnifications_of_paper[i];
  Json json{
      {"name", view.name},
      {"group", view.group},
      {"region_px", {region.x, region.y, region.width, region.height}},
      {"image_x_in_array", ArrayOf(rotation.row(0))},
      {"image_y_in_array", ArrayOf(rotation.row(1))},
      {"axis_in_array", ArrayOf(axis)},
      {"offset_px", ArrayOf(lens.center_px + lens.Scales_px_per_mm().cwiseProduct(view.offset_mm))},
      {"depth_sense", view.depth_sense},
      {"depth_offset_mm", view.depth_offset_mm},
      {"center_in_array_mm", ArrayOf(center)},
      {"depth_of_field_mm", session.depth_of_field_mm},
      {"seed_magnification_px_per_mm", calibration.seed.view_magnification_px_per_mm[i]},
      {"magnification_eq6_px_per_mm", paper ? ArrayOf(*paper) : Json(nullptr)},
      {"rms_px", statistics.rms_px},
      {"mean_px", statistics.mean_px},
      {"max_px", statistics.max_px},
      {"corners", statistics.corners}};
  if (array.model.per_view) json["lens"] = LensParametersJson(lens);
  return json;
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
                     {"covariance", RowsOf(calibration.bundle.covariance.poses[k])},
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

Json SolverJson(const Calibration& calibration) {
  const BundleResult& bundle = calibration.bundle;
  const CalibrationOptions& options = calibration.options;
  Json json{
      {"residuals", bundle.residual_count},
      {"parameters", bundle.parameter_count},
      {"chi2", bundle.TotalChi2()},
      {"corners", options.noise_is_assumed ? "from a table" : "detected in the images"},
      {"corner_noise", options.noise_is_assumed ? "from the residuals" : "from the detector"},
      {"noise_floor_px", calibration.data.floor_px},
      {"robust_sigmas", calibration.bundle_options.robust_sigmas},
      {"outliers", options.robust                                   ? "weighed down (Cauchy)"
                   : options.outliers.scale == OutlierScale::kMrcal ? "removed (mrcal's rule)"
                                                                    : "removed (median rule)"}};
  json["culled_px"] = Json::array();
  for (const PixelRegion& r : options.culled)
    json["culled_px"].push_back({r.x, r.y, r.width, r.height});
  if (options.robust) json["corners_below_half_weight"] = calibration.corners_below_half_weight;
  return json;
}

Json CovariancesJson(const Calibration& calibration) {
  const ArrayCalibration& array = calibration.bundle.state.array;
  const BundleCovariance& covariance = calibration.bundle.covariance;
  return {{"pose_covariance_parameters",
           {"rotation_x_rad", "rotation_y_rad", "rotation_z_rad", "origin_x_mm", "origin_y_mm",
            "origin_z_mm"}},
          {"covariance",
           {{"parameters", array.ParameterNames()},
            {"matrix", RowsOf(array.covariance)},
            {"matrix_of_noise", RowsOf(array.covariance_of_noise)}}},
          {"joint_covariance",
           {{"parameters", covariance.names}, {"matrix", RowsOf(covariance.joint)}}}};
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
  Json json{
      {"schema", kCalibrationSchema},
      {"made_from", made_from},
      {"sensor", {{"width_px", session.sensor.width_px}, {"height_px", session.sensor.height_px}}},
      {"lens", LensJson(calibration)},
      {"views", views},
      {"reprojection", ReprojectionJson(calibration, boards_rejected)}};
  json.update(EvidenceJson(session, calibration));
  json["solver"] = SolverJson(calibration);
  json["poses"] = PosesJson(session, calibration);
  json["rejected"] = rejected;
  json.update(CovariancesJson(calibration));
  return json;
}

std::string ResidualsCsv(const Session& session, const Calibration& calibration) {
  std::string text = std::string(kResidualColumns) + "\n";
  for (const BoardData& board : calibration.data.boards) {
    const Eigen::Matrix2Xd errors = ReprojectionErrors_px(calibration.bundle.state, board);
    for (Eigen::Index i = 0; i < board.Count(); ++i) {
      const int corner = board.corner[static_cast<std::size_t>(i)];
      const Eigen::Matrix2d& w = board.whitening[static_cast<std::size_t>(i)];
      const Eigen::Matrix2d c = (w.transpose() * w).inverse();
      text += CsvLine({calibration.data.images[static_cast<std::size_t>(board.image)].image,
                       session.views[static_cast<std::size_t>(board.view)].name,
                       std::to_string(corner % session.target.columns),
                       std::to_string(corner / session.target.columns),
                       FormatShortest(board.pixels(0, i)), FormatShortest(board.pixels(1, i)),
                       FormatFixed(errors(0, i), 6), FormatFixed(errors(1, i), 6),
                       FormatShortest(c(0, 0)), FormatShortest(c(0, 1)), FormatShortest(c(1, 1))});
    }
  }
  return text;
}

}  // namespace telestrain
