#include <cmath>

#include "base/numbers.h"
#include "calibration/calibration_json.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;

Json StageJson(const Calibration& calibration) {
  const AmbiguityDecision& decision = calibration.seed.decision;
  Json json{{"boards", decision.boards},
            {"nominal_margin_deg", decision.smallest_nominal_margin_deg},
            {"pairs", decision.stage_pairs},
            {"agreeing", decision.stage_agreeing}};
  // Without a move, or without one that decides, there is no such number.
  const bool decided = decision.stage_pairs > 0;
  json["margin_px"] = decided ? Json(decision.smallest_stage_margin_px) : Json(nullptr);
  json["nominal_agrees"] =
      decided ? Json(decision.stage_agreeing == decision.stage_pairs) : Json(nullptr);
  const auto of_moves = [&](const char* key, const Json& value) {
    json[key] = calibration.bundle.stage_count > 0 ? value : Json(nullptr);
  };
  of_moves("axis_in_array", ArrayOf(calibration.bundle.state.stage_axis_in_array));
  of_moves("axis_to_nominal_deg", calibration.stage.axis_to_nominal_deg);
  of_moves("travel_scale_relative", calibration.bundle.state.stage_scale_relative);
  of_moves("rms_travel_error_um", calibration.stage.rms_travel_error_um);
  of_moves("twin_cost_ratio", calibration.stage.twin_chi2_ratio);
  return json;
}

// The paper's Fig. 5.
Json ScreeningJson(const BranchScreening& screening) {
  return {{"view_pairs", screening.view_pairs},
          {"spread_as_chosen_deg", screening.chosen_spread_deg},
          {"spread_one_view_flipped_deg", screening.mixed_spread_deg},
          {"decisive", screening.IsDecisive()}};
}

Json CrossValidationJson(const CrossValidation& validation) {
  if (validation.folds == validation.folds_skipped) return nullptr;
  return {{"folds", validation.folds},
          {"folds_skipped", validation.folds_skipped},
          {"rms_px", validation.rms_px},
          {"expected_rms_px", validation.expected_rms_px},
          {"normalised_rms", validation.normalised_rms},
          {"worst_image", validation.worst_image},
          {"worst_normalised_rms", validation.worst_normalised_rms},
          {"magnification_change_ppm", validation.magnification_change_ppm}};
}

// What the adjustment moves of the target: its bows. The rest stays as certified.
Json TargetJson(const Session& session, const Calibration& calibration) {
  const TargetShape& shape = calibration.bundle.state.target;
  Json boards = Json::array();
  for (std::size_t b = 0; b < shape.boards.size(); ++b)
    boards.push_back({{"group", session.target.boards[b].group},
                      {"bow_x_um", 1000 * shape.boards[b].bow_x_mm},
                      {"bow_y_um", 1000 * shape.boards[b].bow_y_mm}});
  return {{"boards", boards}, {"bow_is_estimated", calibration.bundle_options.estimate_bow}};
}

Json ModelTestsJson(const Calibration& calibration) {
  Json tests = Json::array();
  for (const ModelTest& test : calibration.model_tests) {
    const bool is_start = test.added.empty();  // what the first test compares with
    tests.push_back({{"added", is_start ? "start" : test.added},
                     {"model", test.model},
                     {"parameters", test.added_parameters},
                     {"chi2", test.chi2},
                     {"f_statistic", is_start ? Json(nullptr) : Json(test.f_statistic)},
                     {"p_value", is_start ? Json(nullptr) : Json(test.p_value)},
                     {"accepted", is_start ? Json(nullptr) : Json(test.accepted)}});
  }
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
  const LensModel& model = calibration.bundle.state.array.model;
  if (!model.aspect) gauge.push_back("aspect ratio: fixed at 1");
  if (!model.telecentricity) gauge.push_back("residual telecentricity: fixed at 0");
  gauge.push_back(
      "scale: from the certified corner pitch; distance, height and tilts of the boards: as "
      "certified; their standard uncertainties are carried into every covariance");
  return gauge;
}

}  // namespace

Json EvidenceJson(const Session& session, const Calibration& calibration) {
  return {{"stage_decision", StageJson(calibration)},
          {"branch_screening", ScreeningJson(calibration.seed.screening)},
          {"model_tests", ModelTestsJson(calibration)},
          {"cross_validation", CrossValidationJson(calibration.cross_validation)},
          {"target", TargetJson(session, calibration)},
          {"gauge", GaugeJson(session, calibration)}};
}

}  // namespace telestrain
