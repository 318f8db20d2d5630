// The paper's section 4.3: eight load cycles of 0 to 750 microstrain against four strain gauges,
// Fig. 16, and what makes the two differ.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/numbers.h"
#include "simulation/random_stream.h"
#include "study/image_experiment.h"
#include "study/statistics.h"
#include "study/study.h"

namespace telestrain {
namespace {

constexpr int kPaperCycles = 8;
constexpr int kStepsPerCycle = 6;  // 250, 500, 750, 500, 250, 0
constexpr double kFullLoad_microstrain = 750;
constexpr int kGauges = 4;
// The switches: amounts are ours, the paper names the effects without numbers.
constexpr double kGaugeNoise_microstrain = 2.0;
constexpr double kBenchBending_microstrain = 10.0;  // of the outermost fibre at full load
// The mean strain at four points against that of the area, relative: 1 % a point.
constexpr double kPointMismatch = 0.005;
// Best published figures near this design: dual-field telecentric extensometer, bi-prism.
constexpr double kPeerRmse_microstrain = 4.4;
constexpr double kStrainLimit_microstrain = 1.0;  // camera against truth, RMS

struct GaugeSwitches {
  bool noise = false, mismatch = false;
};

struct Arm {
  std::string name;
  std::vector<double> camera, gauge;  // microstrain, states after the reference
  std::vector<double> Differences() const {
    std::vector<double> differences;
    for (std::size_t i = 0; i < camera.size(); ++i) differences.push_back(camera[i] - gauge[i]);
    return differences;
  }
  double Slope() const {
    const double count = static_cast<double>(camera.size());
    double gauge_mean = 0, camera_mean = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < camera.size(); ++i) {
      gauge_mean += gauge[i] / count;
      camera_mean += camera[i] / count;
    }
    for (std::size_t i = 0; i < camera.size(); ++i) {
      xx += (gauge[i] - gauge_mean) * (gauge[i] - gauge_mean);
      xy += (gauge[i] - gauge_mean) * (camera[i] - camera_mean);
    }
    return xx > 0 ? xy / xx : 0;
  }
};

VirtualExperimentOptions ExperimentOf(const StudyOptions& options, bool bends) {
  VirtualExperimentOptions experiment;
  experiment.seed = options.seed;
  experiment.threads = options.threads;
  experiment.binning = options.binning;
  experiment.poses = options.Scaled(12, 6);
  experiment.cut_off_poses = 0;
  experiment.ruler_images = 0;
  experiment.load_cycles = options.Scaled(kPaperCycles, 1);
  experiment.pipe_states = 1 + kStepsPerCycle * experiment.load_cycles;
  experiment.strain_max_microstrain = kFullLoad_microstrain;
  experiment.bending_max_microstrain = bends ? kBenchBending_microstrain : 0;
  experiment.gauge_sigma_microstrain = 0;  // the switches add their own
  return experiment;
}

// Mean of four gauges at 0, 90, 180 and 270 deg around the pipe, relative to the reference state.
std::vector<double> GaugeMeans(const ImageOutcome& images, const GaugeSwitches& switches,
                               std::uint64_t seed) {
  RandomStream random(CombineKeys(seed, 2001));
  const double local = switches.mismatch ? 1 + kPointMismatch : 1;
  std::vector<double> means;
  double reference = 0;
  for (std::size_t i = 0; i < images.truth.pipe.size(); ++i) {
    double mean = 0;
    for (int gauge = 0; gauge < kGauges; ++gauge) {
      const double angle_rad = 2 * std::numbers::pi * gauge / kGauges;
      const double strain = 1e6 * images.truth.pipe[i].pipe.AxialStrain(angle_rad);
      const double noise = switches.noise ? kGaugeNoise_microstrain * random.Normal() : 0;
      mean += (strain * local + noise) / kGauges;
    }
    if (i == 0)
      reference = mean;
    else
      means.push_back(mean - reference);
  }
  return means;
}

std::vector<double> CameraOf(const ImageOutcome& images) {
  std::vector<double> strains;
  for (std::size_t i = 1; i < images.pipe.states.size(); ++i)
    strains.push_back(1e6 * images.pipe.states[i].strain.axial_strain);
  return strains;
}

std::vector<Arm> ArmsOf(const ImageOutcome& straight, const ImageOutcome& bending,
                        std::uint64_t seed) {
  struct Plan {
    const char* name;
    const ImageOutcome& images;
    GaugeSwitches switches;
  };
  const Plan plans[] = {{"ideal gauges, pure tension", straight, {}},
                        {"gauge noise", straight, {true, false}},
                        {"bench bending", bending, {}},
                        {"area against point", straight, {false, true}},
                        {"all of them", bending, {true, true}}};
  std::vector<Arm> arms;
  for (const Plan& plan : plans)
    arms.push_back(
        {plan.name, CameraOf(plan.images), GaugeMeans(plan.images, plan.switches, seed)});
  return arms;
}

StudyTable TableOf(const std::vector<Arm>& arms) {
  StudyTable table{"arms",
                   "Camera minus mean of four gauges",
                   {{"switch", ""},
                    {"states", ""},
                    {"mean", "µε"},
                    {"RMS", "µε"},
                    {"largest", "µε"},
                    {"slope", "camera / gauge"}},
                   {}};
  for (const Arm& arm : arms) {
    const ErrorFigures figures = FiguresOf(arm.Differences());
    table.rows.push_back({arm.name, StudyNumber{static_cast<double>(figures.count), 0},
                          StudyNumber{figures.mean, 3}, StudyNumber{figures.rms, 3},
                          StudyNumber{figures.max_abs, 3}, StudyNumber{arm.Slope(), 5}});
  }
  return table;
}

std::vector<double> Numbered(std::size_t count) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) numbers.push_back(static_cast<double>(i) + 1);
  return numbers;
}

std::vector<StudyPlot> PlotsOf(const std::vector<Arm>& arms) {
  const Arm& all = arms.back();
  const std::vector<double> states = Numbered(all.camera.size());
  StudyPlot cycles{"fig16",
                   "Load cycles: camera and gauges (paper Fig. 16)",
                   "Axial strain in every state, all switches on.",
                   {"state", false},
                   {"axial strain / µε", false},
                   {{"mean of four gauges", SeriesKind::kLine, states, all.gauge, {}},
                    {"camera array", SeriesKind::kMarkers, states, all.camera, {}}},
                   {}};
  StudyPlot differences{"difference",
                        "Camera minus gauges",
                        "What each switch makes of the difference.",
                        {"gauge strain / µε", false},
                        {"camera - gauges / µε", false},
                        {},
                        {}};
  for (const Arm& arm : arms)
    differences.series.push_back(
        {arm.name, SeriesKind::kMarkers, arm.gauge, arm.Differences(), {}});
  return {cycles, differences};
}

void Compare(const StudyOptions& options, const ImageOutcome& straight,
             const std::vector<Arm>& arms, StudyResult& result) {
  const auto text = [](double value, int decimals) { return FormatFixed(value, decimals); };
  const ErrorFigures truth = FiguresOf(straight.StrainErrors_microstrain());
  const ErrorFigures noisy = FiguresOf(arms[1].Differences());
  const ErrorFigures all = FiguresOf(arms.back().Differences());
  double uncertainty = 0;
  for (std::size_t i = 1; i < straight.pipe.states.size(); ++i)
    uncertainty = std::max(uncertainty, 1e6 * straight.pipe.states[i].strain.standard_uncertainty);
  const double limit = kStrainLimit_microstrain * options.binning;
  result.comparison = {
      {"camera against truth: RMS error", "µε", "-", text(truth.rms, 3), "≤ " + text(limit, 1),
       truth.rms <= limit, "pure tension; the limit scales with the binning"},
      {"camera against truth: largest error", "µε", "-", text(truth.max_abs, 3),
       "≤ 4 u = " + text(4 * uncertainty, 2), truth.max_abs <= 4 * uncertainty,
       "u: the largest standard uncertainty that the program states; 48 states exceed 4 u by "
       "chance "
       "once in 300 times"},
      {"camera against noisy gauges: RMS", "µε", "-", text(noisy.rms, 2),
       "≤ " + text(kPeerRmse_microstrain, 1), noisy.rms <= kPeerRmse_microstrain,
       "gauge noise 2 µε; limit: best published RMSE near this design (dual-field "
       "telecentric extensometer)"},
      {"camera against gauges, all switches: RMS", "µε",
       "\"micro-strain level\", Fig. 16 without numbers", text(all.rms, 2), "-", std::nullopt,
       "gauge noise 2 µε, bench bending 10, area against point 0.5 %: our amounts"},
      {"same: largest", "µε", "-", text(all.max_abs, 2), "-", std::nullopt, "the same"},
      {"same: slope camera / gauges", "", "\"high consistency\"", text(arms.back().Slope(), 4), "-",
       std::nullopt, "mismatch of area and point is a slope error"},
      {"subset", "px", "about 500", std::to_string(straight.pipe.options.subset_px), "-",
       std::nullopt, "many small subsets fitted by a linear field instead of a few large ones"}};
}

std::string AnswerOf(const ImageOutcome& straight, const std::vector<Arm>& arms) {
  const auto rms = [](const Arm& arm) { return FormatFixed(FiguresOf(arm.Differences()).rms, 2); };
  return "Against the truth the camera array is off by " +
         FormatFixed(FiguresOf(straight.StrainErrors_microstrain()).rms, 3) +
         " µε RMS. Against four gauges the RMS difference is " + rms(arms[0]) +
         " with ideal gauges, " + rms(arms[1]) + " with gauge noise, " + rms(arms[2]) +
         " with bench bending, " + rms(arms[3]) + " with the mismatch of area and point, " +
         rms(arms[4]) + " µε with all of them.";
}

}  // namespace

Result<StudyResult> StudyPaperStrain(const StudyOptions& options,
                                     const std::filesystem::path& folder, Console& console) {
  TELESTRAIN_ASSIGN_OR_RETURN(
      const ImageOutcome straight,
      RunImageExperiment(ExperimentOf(options, false), folder, "tension", console));
  TELESTRAIN_ASSIGN_OR_RETURN(
      const ImageOutcome bending,
      RunImageExperiment(ExperimentOf(options, true), folder, "bending", console));
  const std::vector<Arm> arms = ArmsOf(straight, bending, options.seed);
  StudyResult result;
  result.study = "paper-strain";
  result.title = "Strain of the pipe against gauges, as in section 4.3 of the paper";
  result.question =
      "How well does the camera array follow load cycles of 0 to 750 µε, and what "
      "makes it differ from four strain gauges?";
  result.answer = AnswerOf(straight, arms);
  Compare(options, straight, arms, result);
  result.plots = PlotsOf(arms);
  result.tables = {TableOf(arms)};
  const std::string image = straight.session.pipe_states.front().image;
  result.images = {{"tension/" + image, "The pipe in its reference state, four views"}};
  result.notes = {
      "Gauges sit at 0, 90, 180 and 270 deg around the pipe; the camera sees the arc that faces "
      "it, "
      "so bending of the bench moves the camera and not the gauges' mean.",
      "Between the states the pipe moves by up to 0.05 mm and 0.05 deg, as in a real fixture."};
  result.settings = {{"load cycles", std::to_string(ExperimentOf(options, false).load_cycles), ""},
                     {"states", std::to_string(straight.pipe.states.size()), ""},
                     {"sensor",
                      std::to_string(straight.session.sensor.width_px) + " x " +
                          std::to_string(straight.session.sensor.height_px),
                      "px"}};
  return result;
}

}  // namespace telestrain
