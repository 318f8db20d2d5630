#include "diagnostics/residual_pattern.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/numbers.h"
#include "diagnostics/pattern_search.h"

namespace telestrain {
namespace {

// Whitened residuals below this are rounding and have no distribution to speak of.
constexpr double kRounding = 1e-3;

const SpatialTest* StrongestSpatial(const NoiseReport& noise) {
  const auto found = std::min_element(
      noise.spatial.begin(), noise.spatial.end(),
      [](const SpatialTest& a, const SpatialTest& b) { return a.p_value < b.p_value; });
  return found == noise.spatial.end() ? nullptr : &*found;
}

// Neighbours are alike though no known pattern was found.
void AddUnknown(const CalibrationData& data, const ArrayState& state, const PatternOptions& options,
                ResidualVerdict& verdict) {
  const SpatialTest* test = StrongestSpatial(verdict.noise);
  if (!verdict.findings.empty() || !test || verdict.noise.chi_square.sigma0 < kRounding ||
      test->adjusted_p_value >= options.spatial_significance)
    return;
  PatternFinding finding;
  finding.view = test->view;
  finding.p_value = test->p_value;
  finding.adjusted_p_value = test->adjusted_p_value;
  // Of neighbours the likeness is the pattern's share of the variance.
  const ResidualSummary summary = Summarise(OfView(ResidualsOf(data, state), test->view));
  finding.share_of_squares = std::clamp(test->morans_i, 0.0, 1.0);
  finding.rms_px = summary.sigma_px * std::sqrt(finding.share_of_squares);
  Describe(data, state, finding);
  verdict.findings.push_back(finding);
}

// Whether the corners state their noise right; a twentieth is as good as a stated noise gets.
std::string SizeText(const ChiSquareTest& test) {
  if (test.p_value > 1e-3 || std::abs(test.sigma0 - 1) < 0.05)
    return "They are as large as the corners' stated noise.";
  return "They are " + FormatFixed(test.sigma0, 2) +
         " times as large as the corners' stated noise.";
}

void Conclude(const PatternOptions& options, ResidualVerdict& verdict) {
  if (!verdict.findings.empty()) {
    verdict.kind = ResidualVerdict::Kind::kPattern;
    verdict.text = "A pattern remains: looks like " + verdict.findings.front().text;
  } else if (verdict.noise.chi_square.sigma0 >= kRounding &&
             verdict.noise.normality.p_value < options.normality_significance) {
    verdict.kind = ResidualVerdict::Kind::kNotNormal;
    verdict.text = std::string(
                       "No pattern remains, but the residuals are not normally "
                       "distributed: ") +
                   (verdict.noise.normality.excess_kurtosis > 0
                        ? "large ones are too many, so some corners are mistakes or noisier."
                        : "large ones are too few.");
  } else {
    verdict.text = "The residuals are noise.";
  }
}

}  // namespace

ResidualVerdict JudgeResiduals(const CalibrationData& data, const ArrayState& state,
                               const PatternOptions& options) {
  ResidualVerdict verdict;
  PatternSearch search(data, state, options);
  verdict.degrees = search.Degrees();
  verdict.noise = TestNoise(ResidualsOf(data, state), verdict.degrees, data.target.columns);
  while (static_cast<int>(search.findings.size()) < options.most_findings && search.FindOne()) {
  }
  verdict.findings = std::move(search.findings);
  verdict.patterns_asked = search.asked;
  AddUnknown(data, state, options, verdict);
  Conclude(options, verdict);
  verdict.size_text = SizeText(verdict.noise.chi_square);
  return verdict;
}

std::vector<PatternFinding> ExplainLeftOutBoards(const CalibrationData& all,
                                                 const CalibrationData& used,
                                                 const ArrayState& state) {
  std::map<std::string, int> image_index;
  for (std::size_t i = 0; i < used.images.size(); ++i)
    image_index[used.images[i].image] = static_cast<int>(i);
  std::set<std::pair<int, int>> kept;
  for (const BoardData& board : used.boards) kept.emplace(board.image, board.view);
  const double fits_px =
      std::max(0.1, 3 * Summarise(ResidualsOf(used, state)).rms_of_inliers_per_scalar_px);
  std::vector<PatternFinding> findings;
  for (BoardData board : all.boards) {
    const auto found = image_index.find(all.images[static_cast<std::size_t>(board.image)].image);
    if (found == image_index.end() || kept.contains({found->second, board.view})) continue;
    board.image = found->second;
    PatternFinding finding;
    finding.labels = ReadLabels(board, used.target, state);
    // A good board that went with a bad one of its image.
    if (finding.labels.rms_as_labelled_px < fits_px) continue;
    finding.kind =
        finding.labels.IsMislabelled() ? PatternKind::kMislabelled : PatternKind::kBoardMisfit;
    finding.view = board.view;
    finding.board = board.geometry.board;
    finding.image = board.image;
    finding.rms_px = finding.labels.rms_as_labelled_px;
    finding.p_value = finding.adjusted_p_value = 0;
    Describe(used, state, finding);
    findings.push_back(finding);
  }
  return findings;
}

}  // namespace telestrain
