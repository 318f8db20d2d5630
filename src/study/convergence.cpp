// How the figures follow from the number of poses, the tilt range and the noise.
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/numbers.h"
#include "base/parallel.h"
#include "study/corner_experiment.h"
#include "study/study.h"

namespace telestrain {
namespace {

constexpr int kBasePoses = 18;
constexpr double kBaseNoise_px = 0.1, kBaseTilt_deg = 8.0;
constexpr int kRepeats = 20;  // calibrations per point of a curve
constexpr int kRulers = 50;

// One point of a curve: figures over all repeats.
struct Point {
  double value = 0;  // of what is varied
  double rms_px = 0, expected_rms_px = 0;
  double ruler_rms_um = 0, noise_limit_um = 0;
  double calibration_um = 0;  // RMS error of the calibration alone, without noise of the crosses
  double stated_um = 0;       // RMS of the calibration part as stated
};

struct Sweep {
  std::string id, title, label;
  bool log = false;
  std::vector<Point> points;
};

CornerExperiment Base(const StudyOptions& options) {
  CornerExperiment experiment;
  experiment.instrument.seed = options.seed;
  experiment.noise_px = kBaseNoise_px;
  experiment.poses = kBasePoses;
  experiment.tilt_deg = kBaseTilt_deg;
  experiment.rulers = kRulers;
  return experiment;
}

Result<Point> RunPoint(double value, const CornerExperiment& base, const StudyOptions& options) {
  const int repeats = options.Scaled(kRepeats, 3);
  std::vector<std::optional<Result<CornerOutcome>>> outcomes(static_cast<std::size_t>(repeats));
  ParallelFor(repeats, options.threads, [&](int repeat) {
    CornerExperiment experiment = base;
    experiment.instrument.seed = 1000 * options.seed + static_cast<std::uint64_t>(repeat);
    outcomes[static_cast<std::size_t>(repeat)] = RunCornerExperiment(experiment);
  });
  Point point;
  point.value = value;
  std::vector<double> all_um, systematic_um, stated_um;
  const auto append = [](std::vector<double>& all, const std::vector<double>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  for (const auto& one : outcomes) {
    if (!one->ok()) return one->error();
    const CornerOutcome& outcome = one->value();
    const BundleResult& bundle = outcome.calibration.bundle;
    point.rms_px += outcome.calibration.all.rms_px / repeats;
    point.expected_rms_px +=
        base.noise_px / repeats *
        std::sqrt(1 - static_cast<double>(bundle.parameter_count) / bundle.residual_count);
    point.noise_limit_um +=
        1000 * base.noise_px / repeats / bundle.state.array.Magnification_px_per_mm();
    append(all_um, outcome.ruler_error_um);
    append(systematic_um, outcome.ruler_systematic_um);
    append(stated_um, outcome.ruler_calibration_part_um);
  }
  point.ruler_rms_um = FiguresOf(all_um).rms;
  point.calibration_um = FiguresOf(systematic_um).rms;
  point.stated_um = FiguresOf(stated_um).rms;
  return point;
}

template <typename Set>
Status RunSweep(const StudyOptions& options, std::initializer_list<double> values, Set set,
                Sweep& sweep) {
  for (const double value : values) {
    CornerExperiment experiment = Base(options);
    set(experiment, value);
    TELESTRAIN_ASSIGN_OR_RETURN(const Point point, RunPoint(value, experiment, options));
    sweep.points.push_back(point);
  }
  return {};
}

// The point of the sweep over poses that the other sweeps have in common.
const Point& BasePoint(const Sweep& poses) {
  const auto at = std::find_if(poses.points.begin(), poses.points.end(),
                               [](const Point& point) { return point.value == kBasePoses; });
  TELESTRAIN_CHECK(at != poses.points.end(), "the sweep over poses leaves the base out");
  return *at;
}

StudyPlot PlotOf(const Sweep& sweep) {
  StudyPlot plot{sweep.id,
                 sweep.title,
                 "RMS over all calibrations of a point; the base is 18 poses, 8 deg and 0.1 px.",
                 {sweep.label, sweep.log},
                 {"RMS error of the ruler / µm", true},
                 {},
                 {}};
  StudySeries total{"ruler error", SeriesKind::kLine}, limit{"noise limit", SeriesKind::kLine};
  StudySeries part{"calibration alone", SeriesKind::kLine};
  StudySeries stated{"calibration alone, stated", SeriesKind::kLine};
  for (const Point& point : sweep.points) {
    for (StudySeries* series : {&total, &limit, &part, &stated}) series->x.push_back(point.value);
    total.y.push_back(point.ruler_rms_um);
    limit.y.push_back(point.noise_limit_um);
    part.y.push_back(point.calibration_um);
    stated.y.push_back(point.stated_um);
  }
  plot.series = {total, limit, part, stated};
  return plot;
}

StudyTable TableOf(const Sweep& sweep) {
  StudyTable table{sweep.id,
                   sweep.title,
                   {{sweep.label, ""},
                    {"reprojection RMS", "px"},
                    {"expected", "px"},
                    {"ruler RMS error", "µm"},
                    {"noise limit", "µm"},
                    {"calibration alone", "µm"},
                    {"stated", "µm"}},
                   {}};
  for (const Point& point : sweep.points)
    table.rows.push_back({StudyNumber{point.value, point.value < 1 ? 2 : 0},
                          StudyNumber{point.rms_px, 4}, StudyNumber{point.expected_rms_px, 4},
                          StudyNumber{point.ruler_rms_um, 3}, StudyNumber{point.noise_limit_um, 3},
                          StudyNumber{point.calibration_um, 3}, StudyNumber{point.stated_um, 3}});
  return table;
}

void Compare(const StudyOptions& options, const Sweep& poses, StudyResult& result) {
  const Point& base = BasePoint(poses);
  const double count = options.Scaled(kRepeats, 3) * kRulers;
  const double limit_um = base.noise_limit_um * (1.05 + 4 / std::sqrt(2 * count));
  const auto text = [](double value) { return FormatFixed(value, 3); };
  result.comparison = {
      {"ruler RMS error, 18 poses, 0.1 px", "µm", "-", text(base.ruler_rms_um),
       "≤ " + text(limit_um), base.ruler_rms_um <= limit_um,
       "limit: noise / magnification, 5 % for the calibration, 4 sigma of chance"},
      {"reprojection RMS, 18 poses, 0.1 px", "px", "-", FormatFixed(base.rms_px, 4),
       FormatFixed(base.expected_rms_px, 4) + " ± 1 %",
       std::abs(base.rms_px / base.expected_rms_px - 1) <= 0.01,
       "limit: sigma sqrt(1 - parameters / residuals)"}};
}

std::string AnswerOf(const Sweep& poses) {
  const Point &few = poses.points.front(), &many = poses.points.back();
  return "The ruler's error is the corner noise of its own crosses: " +
         FormatFixed(BasePoint(poses).ruler_rms_um, 3) + " µm at 0.1 px and 18 poses, limit " +
         FormatFixed(BasePoint(poses).noise_limit_um, 3) + " µm. The calibration alone errs by " +
         FormatFixed(few.calibration_um, 3) + " µm at " + FormatShortest(few.value) +
         " poses and by " + FormatFixed(many.calibration_um, 3) + " µm at " +
         FormatShortest(many.value) + ".";
}

}  // namespace

Result<StudyResult> StudyConvergence(const StudyOptions& options, const std::filesystem::path&,
                                     Console& console) {
  Sweep poses{"poses", "Against the number of poses", "poses of the target", true, {}};
  Sweep tilt{
      "tilt", "Against the tilt range", "tilt about the pipe's axis, half range / deg", false, {}};
  Sweep noise{"noise", "Against the corner noise", "noise of a corner coordinate / px", true, {}};
  TELESTRAIN_RETURN_IF_ERROR(RunSweep(
      options, {6, 9, 18, 36, 72, 144},
      [](CornerExperiment& e, double value) { e.poses = static_cast<int>(value); }, poses));
  console.Progress("study", 1, 3);
  TELESTRAIN_RETURN_IF_ERROR(RunSweep(
      options, {1, 2, 4, 8, 12}, [](CornerExperiment& e, double value) { e.tilt_deg = value; },
      tilt));
  console.Progress("study", 2, 3);
  TELESTRAIN_RETURN_IF_ERROR(RunSweep(
      options, {0.02, 0.05, 0.1, 0.2, 0.4, 0.8},
      [](CornerExperiment& e, double value) { e.noise_px = value; }, noise));
  console.Progress("study", 3, 3);
  StudyResult result;
  result.study = "convergence";
  result.title = "What more poses, more tilt and less noise bring";
  result.question =
      "How do the reprojection error and the ruler's error follow from the number of poses, the "
      "range of tilts and the corner noise?";
  result.answer = AnswerOf(poses);
  Compare(options, poses, result);
  for (const Sweep* sweep : {&poses, &tilt, &noise}) {
    result.plots.push_back(PlotOf(*sweep));
    result.tables.push_back(TableOf(*sweep));
  }
  result.settings = {{"calibrations per point", std::to_string(options.Scaled(kRepeats, 3)), ""},
                     {"rulers per calibration", std::to_string(kRulers), ""}};
  return result;
}

}  // namespace telestrain
