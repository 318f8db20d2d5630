#include "calibration/model_choice.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace telestrain {
namespace {

constexpr double kPi = 3.14159265358979323846;

// One offer to the data.
struct ModelStep {
  const char* name;
  void (*add)(BundleOptions&);
  // Takes the step back; false when it is not free or what stands on it is.
  bool (*remove)(BundleOptions&);
};

constexpr std::size_t kDistortionSteps = 4;  // the first ones

bool TakeBack(bool& flag, bool is_needed = false) {
  if (!flag || is_needed) return false;
  flag = false;
  return true;
}

// First what every lens has, last what only a defect explains. The bow comes before the aspect and
// the lens per view, which can imitate it.
constexpr std::array<ModelStep, 8> kSteps{{
    {"k1", [](BundleOptions& o) { o.model.distortion[0] = true; },
     [](BundleOptions& o) { return TakeBack(o.model.distortion[0], o.model.distortion[1]); }},
    {"p1 p2", [](BundleOptions& o) { o.model.distortion[2] = o.model.distortion[3] = true; },
     [](BundleOptions& o) {
       return TakeBack(o.model.distortion[2]) && TakeBack(o.model.distortion[3]);
     }},
    {"k2", [](BundleOptions& o) { o.model.distortion[0] = o.model.distortion[1] = true; },
     [](BundleOptions& o) { return TakeBack(o.model.distortion[1], o.model.distortion[4]); }},
    {"k3",
     [](BundleOptions& o) {
       o.model.distortion[0] = o.model.distortion[1] = o.model.distortion[4] = true;
     },
     [](BundleOptions& o) { return TakeBack(o.model.distortion[4]); }},
    {"telecentricity", [](BundleOptions& o) { o.model.telecentricity = true; },
     [](BundleOptions& o) { return TakeBack(o.model.telecentricity); }},
    {"bow of the boards", [](BundleOptions& o) { o.estimate_bow = true; },
     [](BundleOptions& o) { return TakeBack(o.estimate_bow); }},
    {"aspect", [](BundleOptions& o) { o.model.aspect = true; },
     [](BundleOptions& o) { return TakeBack(o.model.aspect); }},
    {"a lens per view", [](BundleOptions& o) { o.model.per_view = true; },
     [](BundleOptions& o) { return TakeBack(o.model.per_view); }},
}};

std::string TextOf(const BundleOptions& options) {
  const std::string lens = ToText(options.model);
  if (!options.estimate_bow) return lens;
  return lens == "none" ? "bow of the boards" : lens + ", bow of the boards";
}

// The state from which `options` are solved: what they do not free is perfect, and there are as
// many lenses as they want.
ArrayState StartFor(const BundleOptions& options, ArrayState state) {
  auto& lenses = state.array.lenses;
  if (options.model.per_view && lenses.size() == 1)
    lenses.resize(state.array.views.size(), lenses.front());
  if (!options.model.per_view) lenses.resize(1);
  for (TelecentricLens& lens : lenses) {
    for (std::size_t i = 0; i < lens.distortion.size(); ++i)
      if (!options.model.distortion[i]) lens.distortion[i] = 0;
    if (!options.model.aspect) lens.aspect = 1;
    if (!options.model.telecentricity) lens.telecentricity_per_mm = 0;
  }
  if (!options.estimate_bow)
    for (BoardShape& board : state.target.boards) board.bow_x_mm = board.bow_y_mm = 0;
  return state;
}

// Everything that may adapt to the corners, the target's bows counted.
int FreeCount(const BundleResult& bundle) { return bundle.parameter_count + bundle.prior_count; }

// Whether `large` fits better than `small`, its special case, by more than chance.
ModelTest Compare(const BundleResult& small, const BundleResult& large, double significance) {
  ModelTest test;
  test.added_parameters = FreeCount(large) - FreeCount(small);
  if (test.added_parameters == 0) return test;
  test.chi2 = large.TotalChi2();
  const double freedom = std::max(1, large.residual_count - large.parameter_count);
  const double variance = std::max(large.TotalChi2() / freedom, 1e-12);  // exact corners have none
  test.f_statistic = (small.TotalChi2() - large.TotalChi2()) / test.added_parameters / variance;
  // The tail of F with thousands of degrees of freedom below is that of chi-square.
  test.p_value = ChiSquareTail(test.f_statistic * test.added_parameters, test.added_parameters);
  test.accepted = test.p_value < significance;
  return test;
}

// Offers what is not free yet, from the first step to the last.
void Grow(const CalibrationData& data, const ModelChoiceOptions& choice, ChosenModel& best) {
  const std::size_t count = choice.distortion_only ? kDistortionSteps : kSteps.size();
  for (std::size_t i = 0; i < count; ++i) {
    const ModelStep& step = kSteps[i];
    BundleOptions offered = best.options;
    step.add(offered);
    auto solved = AdjustBundle(data, StartFor(offered, best.bundle.state), offered);
    if (!solved) continue;  // the data cannot tell what it frees
    BundleResult next = std::move(solved).value();
    ModelTest test = Compare(best.bundle, next, choice.significance);
    if (test.added_parameters == 0) continue;  // free already, within the target's certificate
    test.added = step.name;
    test.model = TextOf(offered);
    best.tests.push_back(test);
    if (!test.accepted) continue;
    best.bundle = std::move(next);
    best.options = offered;
  }
}

// An early step may have stood in for a later one: each is asked again in the company of all.
void Prune(const CalibrationData& data, const BundleOptions& wanted, double significance,
           ChosenModel& best) {
  for (auto step = kSteps.rbegin(); step != kSteps.rend(); ++step) {
    BundleOptions always = wanted;
    if (step->remove(always)) continue;  // wanted whatever the data say
    BundleOptions without = best.options;
    if (!step->remove(without)) continue;
    auto solved = AdjustBundle(data, StartFor(without, best.bundle.state), without);
    if (!solved) continue;
    BundleResult less = std::move(solved).value();
    ModelTest test = Compare(less, best.bundle, significance);
    if (test.added_parameters == 0 || test.accepted) continue;
    test.added = std::string(step->name) + ", asked again";
    test.model = TextOf(without);
    test.chi2 = less.TotalChi2();
    best.tests.push_back(test);
    best.bundle = std::move(less);
    best.options = without;
  }
}

}  // namespace

double ChiSquareTail(double x, int degrees) {
  if (!(x > 0)) return 1;
  // The finite series of the incomplete gamma function for whole and half-whole arguments.
  const bool is_odd = degrees % 2 == 1;
  double sum = 0, term = is_odd ? std::sqrt(2 * x / kPi) : 1.0;
  for (int i = is_odd ? 1 : 0; i < degrees; i += 2) {
    if (i > 1) term *= x / i;
    if (i + 1 < degrees || !is_odd) sum += term;
  }
  return (is_odd ? std::erfc(std::sqrt(x / 2)) : 0.0) + std::exp(-x / 2) * sum;
}

Result<ChosenModel> ChooseModel(const CalibrationData& data, const ArrayState& start,
                                const BundleOptions& options, const ModelChoiceOptions& choice) {
  ChosenModel best;
  best.options = options;
  TELESTRAIN_ASSIGN_OR_RETURN(best.bundle, AdjustBundle(data, StartFor(options, start), options));
  best.tests.push_back({"", TextOf(options), 0, best.bundle.TotalChi2(), 0, 1, true});
  Grow(data, choice, best);
  Prune(data, options, choice.significance, best);
  return best;
}

}  // namespace telestrain
