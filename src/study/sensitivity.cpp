// The error of ruler and strain against each source of error: the table that an uncertainty budget
// is made from. Every source is one change of the virtual experiment, taken through real images.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/numbers.h"
#include "study/image_experiment.h"
#include "study/statistics.h"
#include "study/study.h"

namespace telestrain {
namespace {

using Options = VirtualExperimentOptions;

struct Source {
  const char* name;
  const char* amount;
  void (*apply)(Options& options);
  // What the ruler's mean error must move by, where that is known; 0: not known.
  double expected_ruler_shift_um = 0;
};

// Amounts: what a good instrument of this class may have.
constexpr Source kSources[] = {
    {"none: the instrument of the other lines", "-", [](Options&) {}},
    {"read noise", "3 instead of 1.5 grey", [](Options& o) { o.noise_gray = 3; }},
    {"shot noise", "full well 8000 e", [](Options& o) { o.full_well_electrons = 8000; }},
    {"saturation of the bright plate", "exposure 1.3", [](Options& o) { o.exposure = 1.3; }},
    {"bits of a pixel", "12 instead of 8", [](Options& o) { o.bit_depth = 12; }},
    {"light lost in the corner of the sensor", "40 %",
     [](Options& o) { o.illumination_falloff_percent = 40; }},
    {"illumination gradient", "30 %", [](Options& o) { o.illumination_gradient_percent = 30; }},
    {"dust on the sensor", "40 specks", [](Options& o) { o.dust_specks = 40; }},
    {"blur in focus", "1.6 instead of 0.8 px", [](Options& o) { o.psf_sigma_px = 1.6; }},
    {"defocus and diffraction", "aperture 0.01", [](Options& o) { o.numerical_aperture = 0.01; }},
    {"residual telecentricity", "0.01 %/mm",
     [](Options& o) { o.telecentricity_percent_per_mm = 0.01; }},
    {"distortion", "0.5 instead of 0.05 %", [](Options& o) { o.distortion_percent = 0.5; }},
    {"magnification off its nominal value", "1 %",
     [](Options& o) { o.magnification_error_percent = 1; }},
    {"mirrors off their drawing", "2 mrad, 20 µm",
     [](Options& o) { o.mirror_error_mrad = 2, o.mirror_error_um = 20; }},
    {"vibration in the exposure", "2 µm rms", [](Options& o) { o.vibration_um = 2; }},
    {"warm-up: shift of the views", "2 µm, 10 min preheated",
     [](Options& o) { o.warmup_drift_um = 2; }},
    {"warm-up: shift of the views", "2 µm, not preheated",
     [](Options& o) { o.warmup_drift_um = 2, o.preheat_s = 0; }},
    {"warm-up: magnification", "50 ppm, not preheated",
     [](Options& o) { o.warmup_drift_ppm = 50, o.preheat_s = 0; }},
    {"stage: direction and travel", "1 deg, 10 µm",
     [](Options& o) { o.stage_error_deg = 1, o.stage_sigma_mm = 0.01; }},
    {"target: separation of the boards", "+0.25 µm",
     [](Options& o) { o.separation_error_um = 0.25; }, -0.25},
    {"ruler: length", "+0.25 µm", [](Options& o) { o.ruler_error_um = 0.25; }, 0.25},
    {"rigid motion of the pipe", "0.2 mm, 0.2 deg",
     [](Options& o) { o.rigid_motion_mm = 0.2, o.rigid_rotation_deg = 0.2; }},
    {"bending of the pipe", "50 µε", [](Options& o) { o.bending_max_microstrain = 50; }},
    {"torsion of the pipe", "500 µε", [](Options& o) { o.torsion_max_microstrain = 500; }},
    {"warmer pipe (expands, which the truth counts as strain)", "+5 K",
     [](Options& o) { o.temperature_change_k = 5; }},
    {"pressure in the pipe", "21 MPa", [](Options& o) { o.pressure_max_mpa = 21; }},
    {"curved pipe", "radius 300 mm", [](Options& o) { o.pipe_bend_radius_mm = 300; }},
};

struct Line {
  const Source* source;
  std::string failure;  // not empty: the chain refused the session
  double rms_px = 0;
  ErrorFigures ruler_um, strain;
};

Options BaseOf(const StudyOptions& options) {
  Options experiment;
  experiment.seed = options.seed;
  experiment.threads = options.threads;
  experiment.binning = options.binning;
  experiment.poses = options.Scaled(12, 6);
  experiment.cut_off_poses = 0;
  experiment.ruler_images = options.Scaled(12, 4);
  experiment.pipe_states = 3;
  experiment.gauges = false;
  experiment.bending_max_microstrain = 0;
  return experiment;
}

Result<std::vector<Line>> RunLines(const StudyOptions& options, const std::filesystem::path& folder,
                                   Console& console) {
  std::vector<Line> lines;
  for (const Source& source : kSources) {
    Options experiment = BaseOf(options);
    source.apply(experiment);
    Line& line = lines.emplace_back(Line{&source, {}, 0, {}, {}});
    const auto outcome = RunImageExperiment(experiment, folder, "session", console);
    if (outcome) {
      line.rms_px = outcome->calibration.all.rms_px;
      line.ruler_um = FiguresOf(outcome->RulerErrors_um());
      line.strain = FiguresOf(outcome->StrainErrors_microstrain());
    } else if (outcome.error().kind == ErrorKind::kEstimationFailed && lines.size() > 1) {
      line.failure = outcome.error().message;  // the chain says that it cannot: a finding
    } else {
      return Error{outcome.error().kind, std::string(source.name) + ": " + outcome.error().message};
    }
    console.Progress("study", static_cast<int>(lines.size()),
                     static_cast<int>(std::size(kSources)));
  }
  return lines;
}

StudyTable TableOf(const std::vector<Line>& lines) {
  StudyTable table{"sources",
                   "Error of ruler and strain with one source changed at a time",
                   {{"no.", ""},
                    {"source", ""},
                    {"amount", ""},
                    {"reprojection RMS", "px"},
                    {"ruler mean", "µm"},
                    {"ruler sd", "µm"},
                    {"strain RMS", "µε"},
                    {"strain max", "µε"}},
                   {}};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Line& line = lines[i];
    std::vector<StudyCell> row{StudyNumber{static_cast<double>(i) + 1, 0},
                               std::string(line.source->name), std::string(line.source->amount)};
    if (line.failure.empty())
      for (const StudyNumber& number :
           {StudyNumber{line.rms_px, 4}, StudyNumber{line.ruler_um.mean, 3},
            StudyNumber{line.ruler_um.sd, 3}, StudyNumber{line.strain.rms, 3},
            StudyNumber{line.strain.max_abs, 3}})
        row.emplace_back(number);
    else
      for (const char* text : {"refused", "-", "-", "-", "-"}) row.emplace_back(std::string(text));
    table.rows.push_back(std::move(row));
  }
  return table;
}

StudyPlot PlotOf(const std::vector<Line>& lines, bool ruler) {
  StudyPlot plot{ruler ? "ruler" : "strain",
                 ruler ? "Ruler error by source" : "Strain error by source",
                 "The line is the instrument without any of the sources.",
                 {"no. of the source in the table", false},
                 {ruler ? "RMS error of the ruler / µm" : "RMS error of the strain / µε", true},
                 {},
                 {}};
  StudySeries series{"RMS error", SeriesKind::kMarkers};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!lines[i].failure.empty()) continue;
    series.x.push_back(static_cast<double>(i) + 1);
    series.y.push_back(std::max(1e-4, ruler ? lines[i].ruler_um.rms : lines[i].strain.rms));
  }
  plot.limits = {{series.y.front(), "without the source"}};
  plot.series = {std::move(series)};
  return plot;
}

// A certificate's error reaches the ruler one to one: what the table must show if it is right.
void Compare(const std::vector<Line>& lines, StudyResult& result) {
  const Line& base = lines.front();
  const auto refused = std::count_if(lines.begin(), lines.end(),
                                     [](const Line& line) { return !line.failure.empty(); });
  result.comparison.push_back({"sessions that the chain refused", "", "-", std::to_string(refused),
                               "0", refused == 0, "the notes say why one was refused"});
  for (const Line& line : lines) {
    if (!line.failure.empty()) continue;
    const std::string name = line.source->name;
    const double expected_um = line.source->expected_ruler_shift_um;
    if (expected_um == 0) continue;
    const double shift_um = line.ruler_um.mean - base.ruler_um.mean;
    // The same noise in both runs; what is left differs by a few nanometres.
    constexpr double kBand_um = 0.03;
    result.comparison.push_back({"ruler error from " + name + " " + line.source->amount, "µm",
                                 "±0.25 each", FormatFixed(shift_um, 3),
                                 FormatFixed(expected_um, 2) + " ± 0.03",
                                 std::abs(shift_um - expected_um) <= kBand_um,
                                 "no residual shows it: only the certificate does"});
  }
}

}  // namespace

Result<StudyResult> StudySensitivity(const StudyOptions& options,
                                     const std::filesystem::path& folder, Console& console) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::vector<Line> lines, RunLines(options, folder, console));
  StudyResult result;
  result.study = "sensitivity";
  result.title = "Errors of ruler and strain by source";
  result.question =
      "What does each imperfection of instrument, artefact and pipe do to the result?";
  const Line *worst_ruler = &lines[1], *worst_strain = &lines[1];
  for (const Line& line : lines) {
    if (line.ruler_um.rms > worst_ruler->ruler_um.rms) worst_ruler = &line;
    if (line.strain.rms > worst_strain->strain.rms) worst_strain = &line;
  }
  result.answer = "Without any of them the ruler is off by " +
                  FormatFixed(lines[0].ruler_um.rms, 3) + " µm RMS and the strain by " +
                  FormatFixed(lines[0].strain.rms, 3) + " µε RMS. The ruler suffers most from " +
                  worst_ruler->source->name + " (" + worst_ruler->source->amount + ": " +
                  FormatFixed(worst_ruler->ruler_um.rms, 3) + " µm), the strain from " +
                  worst_strain->source->name + " (" + worst_strain->source->amount + ": " +
                  FormatFixed(worst_strain->strain.rms, 2) + " µε).";
  Compare(lines, result);
  result.plots = {PlotOf(lines, true), PlotOf(lines, false)};
  result.tables = {TableOf(lines)};
  for (const Line& line : lines)
    if (!line.failure.empty())
      result.notes.push_back(std::string(line.source->name) + ", " + line.source->amount + ": " +
                             line.failure);
  result.settings = {{"target images", std::to_string(2 * BaseOf(options).poses), ""},
                     {"ruler images", std::to_string(BaseOf(options).ruler_images), ""},
                     {"pipe states", std::to_string(BaseOf(options).pipe_states), ""}};
  return result;
}

}  // namespace telestrain
