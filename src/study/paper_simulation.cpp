// The paper's section 3: 72 virtual images of the target and 16 of the ruler, the telecentric
// model against the pinhole model on the same corners, Fig. 7 and 8.
#include <algorithm>
#include <cmath>

#include "base/numbers.h"
#include "study/model_outcome.h"
#include "study/statistics.h"
#include "study/study.h"

namespace telestrain {
namespace {

constexpr int kPaperImages = 72, kPaperRulers = 16;
constexpr double kRmsLimit_px = 0.004;   // of images without defects
constexpr double kRulerLimit_um = 0.06;  // largest error of a ruler on images

VirtualExperimentOptions ExperimentOf(const StudyOptions& options) {
  VirtualExperimentOptions experiment;
  experiment.seed = options.seed;
  experiment.threads = options.threads;
  experiment.binning = options.binning;
  experiment.poses = options.Scaled(kPaperImages / 2, 6);
  experiment.cut_off_poses = 0;
  experiment.ruler_images = options.Scaled(kPaperRulers, 4);
  experiment.pipe_states = 0;
  return experiment;
}

StudyTable TableOf(const std::vector<ModelOutcome>& models) {
  StudyTable table{"models",
                   "The models on the same corners and rulers",
                   {{"model", ""},
                    {"corner RMS", "px"},
                    {"corner mean", "px"},
                    {"ruler RMSE", "µm"},
                    {"ruler mean", "µm"},
                    {"ruler max", "µm"},
                    {"remark", ""}},
                   {}};
  for (const ModelOutcome& model : models) {
    const ErrorFigures corner = FiguresOf(model.corner_error_px);
    const ErrorFigures ruler = FiguresOf(model.ruler_error_um);
    table.rows.push_back({model.name, StudyNumber{model.rms_px, 4}, StudyNumber{corner.mean, 4},
                          StudyNumber{ruler.rms, 3}, StudyNumber{ruler.mean, 3},
                          StudyNumber{ruler.max_abs, 3}, model.remark});
  }
  return table;
}

// Of the models of this kind, the one with the smallest residuals.
const ModelOutcome& BestOf(const std::vector<ModelOutcome>& models, ModelKind kind) {
  const ModelOutcome* best = nullptr;
  for (const ModelOutcome& model : models)
    if (model.kind == kind && (best == nullptr || model.rms_px < best->rms_px)) best = &model;
  TELESTRAIN_CHECK(best != nullptr, "no model of the wanted kind");
  return *best;
}

// What an engineer would publish: a pinhole with a free focal length.
const ModelOutcome& BestFree(const std::vector<ModelOutcome>& models) {
  return BestOf(models, ModelKind::kFreePinhole);
}

const ModelOutcome& LockedAt(const std::vector<ModelOutcome>& models, double distance_mm) {
  const auto at = std::find_if(models.begin(), models.end(), [&](const ModelOutcome& model) {
    return model.kind == ModelKind::kLockedPinhole && model.working_distance_mm == distance_mm;
  });
  TELESTRAIN_CHECK(at != models.end(), "no pinhole is locked to this distance");
  return *at;
}

// What the plots compare.
std::vector<const ModelOutcome*> PlottedOf(const std::vector<ModelOutcome>& models) {
  return {&models.front(), &BestFree(models), &LockedAt(models, kNearDistance_mm),
          &LockedAt(models, kMiddleDistance_mm)};
}

StudyPlot CornerPlot(const std::vector<ModelOutcome>& models) {
  StudyPlot plot{"fig7",
                 "Reprojection error, telecentric and pinhole (paper Fig. 7)",
                 "Share of the corners by the norm of their reprojection error, in decades: one "
                 "step is a tenth of a decade.",
                 {"reprojection error / px", true},
                 {"corners / %", false},
                 {},
                 {}};
  for (const ModelOutcome* model : PlottedOf(models)) {
    std::vector<double> decades;
    for (const double error_px : model->corner_error_px)
      decades.push_back(std::log10(std::max(error_px, 1e-5)));
    Histogram histogram = HistogramOf(decades, -5, 2, 70);
    for (double& center : histogram.centers) center = std::pow(10.0, center);
    plot.series.push_back(
        {model->name, SeriesKind::kStep, histogram.centers, histogram.percent, {}});
  }
  return plot;
}

StudyPlot RulerPlot(const std::vector<ModelOutcome>& models) {
  StudyPlot plot{"fig8",
                 "Ruler error image by image (paper Fig. 8)",
                 "Error of the ruler's length, largest of zero and 1 nm to stand on a logarithmic "
                 "axis.",
                 {"ruler image", false},
                 {"|error of the length| / µm", true},
                 {},
                 {}};
  for (const ModelOutcome* model : PlottedOf(models)) {
    StudySeries series{model->name, SeriesKind::kMarkers};
    for (const double error_um : model->ruler_error_um) {
      series.x.push_back(static_cast<double>(series.x.size()) + 1);
      series.y.push_back(std::max(std::abs(error_um), 1e-3));
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

StudyPlot DistancePlot(const std::vector<ModelOutcome>& models) {
  StudyPlot plot{"distance",
                 "What a pinhole model makes of a telecentric array",
                 "Reprojection RMS and ruler RMSE against the working distance that the locked "
                 "focal length states. The array has none: the error falls with 1 / D, down to "
                 "what five coefficients a view leave of one lens's distortion.",
                 {"working distance D / mm", true},
                 {"RMS / px and RMSE / µm", true},
                 {},
                 {{models[0].rms_px, "telecentric RMS / px"}}};
  StudySeries rms{"reprojection RMS / px", SeriesKind::kLine};
  StudySeries ruler{"ruler RMSE / µm", SeriesKind::kLine};
  for (const ModelOutcome& model : models) {
    if (model.kind != ModelKind::kLockedPinhole) continue;
    rms.x.push_back(model.working_distance_mm);
    rms.y.push_back(model.rms_px);
    ruler.x.push_back(model.working_distance_mm);
    ruler.y.push_back(model.RulerRms_um());
  }
  plot.series = {rms, ruler};
  return plot;
}

void Compare(const StudyOptions& options, const ImageOutcome& images,
             const std::vector<ModelOutcome>& models, StudyResult& result) {
  const ModelOutcome& tele = models.front();
  const ModelOutcome& best = BestFree(models);
  const ErrorFigures ruler = FiguresOf(tele.ruler_error_um);
  const double binning = options.binning;
  // The edges of a square have fewer pixels.
  const double rms_limit_px = kRmsLimit_px * std::sqrt(binning);
  const double ruler_limit_um = kRulerLimit_um * binning;
  const auto text = [](double value, int decimals) { return FormatFixed(value, decimals); };
  result.comparison = {
      {"boards found", "", "-",
       std::to_string(images.BoardsUsed()) + " of " + std::to_string(images.BoardViews()), "all",
       images.BoardsUsed() == images.BoardViews(), "every board is whole in its view"},
      {"rulers measured", "", "-",
       std::to_string(ruler.count) + " of " + std::to_string(images.rulers.size()), "all",
       ruler.count == static_cast<int>(images.rulers.size()), "no ruler is left out"},
      {"telecentric: reprojection RMS", "px", "Fig. 7, no number in the text", text(tele.rms_px, 4),
       "≤ " + text(rms_limit_px, 4), tele.rms_px <= rms_limit_px,
       "paper: SolidWorks renderings and the authors' detector"},
      {"telecentric: ruler RMSE", "µm", "Fig. 8, no number in the text", text(ruler.rms, 3), "-",
       std::nullopt, std::to_string(ruler.count) + " rulers of 27.6 mm"},
      {"telecentric: largest ruler error", "µm", "-", text(ruler.max_abs, 3),
       "≤ " + text(ruler_limit_um, 3), ruler.max_abs <= ruler_limit_um,
       "the limit scales with the binning"},
      {"telecentric beats pinhole: reprojection RMS", "px", "yes",
       text(tele.rms_px, 4) + " against " + text(best.rms_px, 4), "smaller",
       tele.rms_px < best.rms_px, "pinhole with focal length and five coefficients free"},
      {"telecentric beats pinhole: ruler RMSE", "µm", "yes",
       text(ruler.rms, 3) + " against " + text(best.RulerRms_um(), 3), "smaller",
       ruler.rms < best.RulerRms_um(), "the same crosses"}};
}

std::string AnswerOf(const std::vector<ModelOutcome>& models) {
  const auto figures = [](const ModelOutcome& model) {
    return FormatFixed(model.rms_px, 4) + " px RMS and a ruler RMSE of " +
           FormatFixed(model.RulerRms_um(), 3) + " µm";
  };
  return "On the same corners the telecentric model leaves " + figures(models.front()) +
         ". A pinhole model with focal length and five coefficients free leaves " +
         figures(BestFree(models)) + " (" + BestFree(models).remark +
         "). Locked to a working distance the error falls with 1 / "
         "D, from " +
         figures(LockedAt(models, kNearDistance_mm)) + " at " + DistanceText(kNearDistance_mm) +
         " to " + figures(LockedAt(models, kFarDistance_mm)) + " at " +
         DistanceText(kFarDistance_mm) +
         ". What is left there is the lens's distortion, whose centre is the middle of the sensor "
         "and not of a view: told that centre, the far pinhole leaves " +
         figures(BestOf(models, ModelKind::kCenteredPinhole)) +
         ". A pinhole camera far enough away is a telecentric one, so a comparison has to say its "
         "working distance.";
}

}  // namespace

Result<StudyResult> StudyPaperSimulation(const StudyOptions& options,
                                         const std::filesystem::path& folder, Console& console) {
  const VirtualExperimentOptions experiment = ExperimentOf(options);
  TELESTRAIN_ASSIGN_OR_RETURN(const ImageOutcome images,
                              RunImageExperiment(experiment, folder, "session", console));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::vector<ModelOutcome> models, FitModels(images, console));
  StudyResult result;
  result.study = "paper-simulation";
  result.title = "Telecentric against pinhole, as in section 3 of the paper";
  result.question =
      "Calibrated from the same virtual images, how far is a pinhole model behind a telecentric "
      "one in reprojection and on the ruler?";
  result.answer = AnswerOf(models);
  Compare(options, images, models, result);
  result.plots = {CornerPlot(models), RulerPlot(models), DistancePlot(models)};
  result.tables = {TableOf(models)};
  const std::string board = images.session.calibration_images.front().image;
  result.images = {{"session/" + board, "A target image (" + board + "), four views on one sensor"},
                   {"session/" + images.session.ruler_images.front(), "A ruler image"}};
  result.notes = {
      "The pinhole arm is a global bundle adjustment on identical corners, weights and rulers, "
      "started at the telecentric solution seen from D, the principal point in the middle of "
      "the view.",
      "Views behind an odd number of mirrors are flipped for the pinhole model."};
  result.settings = {
      {"target images", std::to_string(images.session.calibration_images.size()), ""},
      {"ruler images", std::to_string(images.session.ruler_images.size()), ""},
      {"sensor",
       std::to_string(images.session.sensor.width_px) + " x " +
           std::to_string(images.session.sensor.height_px),
       "px"},
      {"noise", FormatShortest(experiment.noise_gray), "grey levels of 256"},
      {"blur", FormatShortest(experiment.psf_sigma_px), "px"}};
  return result;
}

}  // namespace telestrain
