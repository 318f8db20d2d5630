#pragma once

#include <string>
#include <vector>

#include "diagnostics/noise_tests.h"
#include "diagnostics/residual_labels.h"

namespace telestrain {

// Are the residuals of a calibration noise, and if not, what do they look like?

enum class PatternKind {
  kRadialK1,
  kRadialK2,
  kTangential,      // p1, p2
  kAspect,          // unequal scales along u and v
  kTelecentricity,  // scale falls with depth
  kMagnification,   // one view has a scale of its own
  kBoardFlatness,   // bow and twist: fixed in the board, not in the image
  kBoardGrid,       // pitch, unequal pitches, shear of one board
  kBoardPlace,      // a board lies elsewhere on the plate than certified
  kViewDrift,       // the image of one view moves evenly over the images
  kViewOffset,      // an offset of one view: the calibration is not the optimum of these corners
  kMislabelled,     // one board fits with other labels
  kBoardMisfit,     // one board of one image does not fit, whatever its labels
  kImageMisfit,     // the boards of one image do not fit one pose of the target
  kUnknown          // neighbours are alike, and no known cause explains it
};

struct PatternParameter {
  std::string name;  // with its unit: "k1_per_mm2"
  double value = 0;  // what would have to be added to the calibration's own value
  double sigma = 0;  // standard uncertainty
};

// One cause that the residuals point at.
struct PatternFinding {
  PatternKind kind = PatternKind::kUnknown;
  int view = -1, board = -1, image = -1;  // which one; -1: all, or it does not apply
  std::string name;                       // "k1 of view A2"
  std::string text;                       // a sentence with its size
  std::string remedy;                     // a sentence: what to do
  double rms_px = 0;  // per scalar: what it leaves in the residuals of the corners that it touches
  double share_of_squares = 0;  // of the sum of squares of the residuals before it
  int parameters = 0;           // degrees of freedom of its test
  double f_statistic = 0, p_value = 1, adjusted_p_value = 1;  // Holm, over all patterns asked
  std::vector<PatternParameter> values;
  LabelReading labels;  // kMislabelled, kBoardMisfit
  // Others that explain nearly as much: the corners cannot tell them apart.
  std::vector<std::string> alternatives;
};

struct ResidualVerdict {
  enum class Kind {
    kNoise,      // "The residuals are noise."
    kNotNormal,  // no pattern, but their distribution is not normal
    kPattern     // "A pattern remains: ..."
  };
  Kind kind = Kind::kNoise;
  std::string text;                      // one or two sentences
  std::string size_text;                 // a sentence: how large they are for the stated noise
  std::vector<PatternFinding> findings;  // the first explains most
  NoiseReport noise;                     // of the residuals as they came
  int degrees = 0;                       // of freedom of the residuals
  int patterns_asked = 0;
};

// A false alarm of the whole verdict is less likely than the sum of these.
struct PatternOptions {
  double significance = 0.005;            // of the patterns, Holm-adjusted
  double spatial_significance = 0.002;    // of Moran's I, Holm-adjusted
  double normality_significance = 0.002;  // of the distribution
  int most_findings = 5;
};

// Fits the known patterns to the residuals of a fit, with all that the calibration adjusted beside
// them (score tests with exact degrees of freedom: F-tests, adjusted by Holm over all patterns,
// views, boards and images). Of the significant ones the first named is that with the largest gain
// by Schwarz's criterion (Ann. Statist. 6, 1978); it is taken out and the rest is asked again. A
// board or an image that does not fit is left out and the array is adjusted again by least squares,
// so that it bends nothing else. What was adjusted is read from the state: the lens model, a lens
// per view, the bows when the certificate leaves them open. A view that was knocked once looks like
// one that drifts; a drift along the direction in which two views of a group see depth is nearly
// taken up by the poses and shows weakly. Measured on 1500 simulated calibrations of pure noise:
// 0.6 % false alarms. One thread; 36 images take 0.08 s.
ResidualVerdict JudgeResiduals(const CalibrationData& data, const ArrayState& state,
                               const PatternOptions& options = {});

// What is wrong with the boards that the calibration left out as a whole: those of `all`, the data
// as collected from the observations, that `used` has no more although it has their image, whose
// pose the other boards give. Each is kMislabelled or kBoardMisfit; views, boards and images are
// indices into `used`.
std::vector<PatternFinding> ExplainLeftOutBoards(const CalibrationData& all,
                                                 const CalibrationData& used,
                                                 const ArrayState& state);

}  // namespace telestrain
