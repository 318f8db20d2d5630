#include "measurement/ruler_acceptance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/numbers.h"

namespace telestrain {
namespace {

constexpr double kDegPerRad = 57.29577951308232;
constexpr std::size_t kWorstShown = 5;
// Images whose ends lie within this show one pose: crosses scatter by some um at the noisiest, and
// an error of the field changes over millimetres.
constexpr double kSamePose_mm = 0.01;

// A coordinate of the pose that E may depend on.
struct Coordinate {
  const char* name;
  const char* unit;
  double (*of)(const RulerPose&);
  const char* curvature_name;  // nullptr: an angle, whose range is too small for one
};

constexpr Coordinate kCoordinates[] = {
    {"x", "mm", [](const RulerPose& p) { return p.middle_mm.x(); }, "x²"},
    {"y", "mm", [](const RulerPose& p) { return p.middle_mm.y(); }, "y²"},
    {"depth", "mm", [](const RulerPose& p) { return p.depth_mm; }, "depth²"},
    {"yaw", "°", [](const RulerPose& p) { return p.yaw_deg; }, nullptr},
    {"pitch", "°", [](const RulerPose& p) { return p.pitch_deg; }, nullptr}};
constexpr int kTrendTests = 8;

struct Errors {
  Eigen::VectorXd values;
  std::vector<RulerPose> poses;

  Eigen::VectorXd Centred(const Coordinate& coordinate) const {
    Eigen::VectorXd at(values.size());
    for (Eigen::Index i = 0; i < at.size(); ++i)
      at(i) = coordinate.of(poses[static_cast<std::size_t>(i)]);
    return at.array() - 0.5 * (at.maxCoeff() + at.minCoeff());
  }
};

ErrorTrend MakeTrend(const std::string& on, const std::string& unit, const Estimate& slope,
                     double range, double coverage_factor) {
  const double lever = unit.ends_with("²") ? 0.25 * range * range : range;
  ErrorTrend trend{on, unit, slope, range, slope, false};
  trend.effect_um.value *= lever;
  trend.effect_um.standard_uncertainty *= lever;
  trend.significant = IsSignificant(slope, coverage_factor, kTrendTests);
  return trend;
}

// E on one coordinate, then with its square beside it.
void AddTrends(const Errors& errors, const Coordinate& coordinate, double coverage_factor,
               std::vector<ErrorTrend>& trends) {
  const Eigen::VectorXd at = errors.Centred(coordinate);
  const double range = at.maxCoeff() - at.minCoeff();
  Eigen::MatrixXd design(at.size(), 3);
  design << Eigen::VectorXd::Ones(at.size()), at, at.cwiseAbs2();
  const std::string unit = std::string("µm/") + coordinate.unit;
  if (const auto line = FitLeastSquares(design.leftCols(2), errors.values))
    trends.push_back(
        MakeTrend(coordinate.name, unit, line->Coefficient(1), range, coverage_factor));
  if (!coordinate.curvature_name) return;
  if (const auto parabola = FitLeastSquares(design, errors.values))
    trends.push_back(MakeTrend(coordinate.curvature_name, unit + "²", parabola->Coefficient(2),
                               range, coverage_factor));
}

bool SamePose(const RulerLength& a, const RulerLength& b) {
  return (a.end_a_in_array_mm - b.end_a_in_array_mm).norm() < kSamePose_mm &&
         (a.end_b_in_array_mm - b.end_b_in_array_mm).norm() < kSamePose_mm;
}

// Pooled scatter of images that show one pose, none with a single image per pose.
std::optional<RulerRepeatability> OfRepeatedPoses(const std::vector<const RulerLength*>& used) {
  std::vector<std::vector<double>> groups;
  std::vector<const RulerLength*> first_of;
  for (const RulerLength* length : used) {
    const auto same = std::find_if(first_of.begin(), first_of.end(), [&](const RulerLength* first) {
      return SamePose(*first, *length);
    });
    if (same == first_of.end()) {
      first_of.push_back(length);
      groups.push_back({length->error_um});
    } else {
      groups[static_cast<std::size_t>(same - first_of.begin())].push_back(length->error_um);
    }
  }
  double squares = 0;
  std::size_t repeated = 0;
  for (const auto& group : groups) {
    const Eigen::Map<const Eigen::VectorXd> values(group.data(),
                                                   static_cast<Eigen::Index>(group.size()));
    squares += (values.array() - values.mean()).square().sum();
    repeated += group.size() > 1;
  }
  const int degrees = static_cast<int>(used.size() - groups.size());
  if (degrees == 0) return {};
  return RulerRepeatability{
      std::sqrt(squares / degrees), degrees,
      "pooled over " + CountText(repeated, "pose") + " with more than one image"};
}

RulerRepeatability RepeatabilityOf(const Errors& errors,
                                   const std::vector<const RulerLength*>& used, double sd_um) {
  if (const auto repeated = OfRepeatedPoses(used)) return *repeated;
  Eigen::MatrixXd design(errors.values.size(), 1 + std::size(kCoordinates));
  design.col(0).setOnes();
  Eigen::Index column = 1;
  for (const Coordinate& coordinate : kCoordinates)
    design.col(column++) = errors.Centred(coordinate);
  const auto fit = FitLeastSquares(design, errors.values);
  if (fit)
    return {fit->sigma, fit->degrees_of_freedom,
            "no pose was repeated: scatter about the regression on position, depth and attitude"};
  return {sd_um, static_cast<int>(errors.values.size()) - 1,
          "no pose was repeated: scatter about the mean"};
}

// Root mean square of a budget line over the images; 0 where it is missing.
double LineOf(const std::vector<const RulerLength*>& used, const std::string& source) {
  double squares = 0;
  for (const RulerLength* length : used)
    for (const BudgetLine& line : length->budget)
      if (line.source == source) squares += std::pow(line.standard_uncertainty, 2);
  return std::sqrt(squares / static_cast<double>(used.size()));
}

void AddBiasAndSpread(const Errors& errors, const std::vector<const RulerLength*>& used,
                      RulerAcceptance& acceptance) {
  const double count = static_cast<double>(used.size());
  acceptance.bias_um.value = errors.values.mean();
  acceptance.stated_spread_um = LineOf(used, kCrossPositions);
  double of_mean = acceptance.stated_spread_um / std::sqrt(count);
  if (used.size() > 1) {
    const double sd =
        std::sqrt((errors.values.array() - errors.values.mean()).square().sum() / (count - 1));
    // The standard deviation of a standard deviation, normal errors.
    acceptance.spread_um = {sd, sd / std::sqrt(2 * (count - 1)), static_cast<int>(count) - 1};
    of_mean = std::max(of_mean, sd / std::sqrt(count));
  }
  double variance = of_mean * of_mean;
  for (const char* shared : {kCalibrationNoise, kTargetCertificate, kRulerCertificate})
    variance += std::pow(LineOf(used, shared), 2);
  acceptance.bias_um.standard_uncertainty = std::sqrt(variance);
}

std::string CountSentence(std::size_t count) {
  const int missing = kFewestLengths - static_cast<int>(count);
  return CountText(count, "value") +
         " of one length. VDI/VDE 2634 part 1 asks for at least 35: seven measuring lines of five "
         "test lengths each; " +
         (missing > 0 ? std::to_string(missing) + " more are wanted, and "
                      : std::string("the number is reached, but ")) +
         "one ruler does not cover its several lengths.";
}

std::vector<std::string> NotInBudget(const Session& session) {
  std::vector<std::string> list;
  if (session.ruler.sigma_length_um <= 0)
    list.push_back(
        "The certificate of the ruler: [ruler] sigma_length_um is not given, U does not hold it.");
  const TargetSpec& target = session.target;
  if (target.sigma_separation_um <= 0)
    list.push_back(
        "The distance between the target's boards: [target] sigma_separation_um is not given, U "
        "does not hold it.");
  if (target.sigma_square_um <= 0)
    list.push_back(
        "The target's pitch: [target] sigma_square_um is not given, U does not hold it.");
  return list;
}

double Badness(const RulerLength& length, const RulerDecision& decision) {
  const Verdict verdict = decision.decision ? decision.decision->verdict : Verdict::kUndecided;
  return 1e9 * Severity(verdict) + std::abs(length.error_um) + decision.expanded_uncertainty_um;
}

std::vector<std::size_t> WorstOf(const std::vector<RulerLength>& lengths,
                                 const std::vector<RulerDecision>& decisions) {
  std::vector<std::size_t> order(decisions.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return Badness(lengths[decisions[a].length], decisions[a]) >
           Badness(lengths[decisions[b].length], decisions[b]);
  });
  order.resize(std::min(order.size(), kWorstShown));
  return order;
}

RulerDecision DecideLength(const Session& session, const std::vector<RulerLength>& lengths,
                           std::size_t i, const Eigen::Vector3d& mean_axis_in_array) {
  const AcceptanceSpec& limits = session.acceptance;
  RulerDecision decision;
  decision.length = i;
  decision.pose = PoseOf(lengths[i], mean_axis_in_array);
  decision.expanded_uncertainty_um = limits.coverage_factor * lengths[i].standard_uncertainty_um;
  if (limits.ruler_mpe_um)
    decision.decision = DecideInWords(lengths[i].error_um, decision.expanded_uncertainty_um,
                                      *limits.ruler_mpe_um, limits.decision_rule, "µm");
  return decision;
}

}  // namespace

Eigen::Vector3d MeanViewingDirection(const ArrayCalibration& array) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const TelecentricView& view : array.views) sum += view.ViewingDirection();
  return sum.normalized();
}

RulerPose PoseOf(const RulerLength& length, const Eigen::Vector3d& mean_axis_in_array) {
  const Eigen::Vector3d across = mean_axis_in_array.cross(Eigen::Vector3d::UnitX()).normalized();
  const Eigen::Vector3d along = across.cross(mean_axis_in_array);
  Eigen::Vector3d direction = (length.end_b_in_array_mm - length.end_a_in_array_mm).normalized();
  if (direction.dot(along) < 0) direction = -direction;
  RulerPose pose;
  pose.middle_mm = 0.5 * (length.end_a_in_array_mm + length.end_b_in_array_mm);
  pose.depth_mm = pose.middle_mm.dot(mean_axis_in_array);
  pose.yaw_deg = kDegPerRad * std::atan2(direction.dot(across), direction.dot(along));
  pose.pitch_deg = kDegPerRad * std::asin(std::clamp(direction.dot(mean_axis_in_array), -1.0, 1.0));
  return pose;
}

RulerAcceptance AcceptRuler(const Session& session, const ArrayCalibration& array,
                            const std::vector<RulerLength>& lengths) {
  RulerAcceptance acceptance;
  acceptance.mpe_um = session.acceptance.ruler_mpe_um;
  acceptance.not_in_budget = NotInBudget(session);
  const Eigen::Vector3d axis = MeanViewingDirection(array);
  std::vector<const RulerLength*> used;
  Errors errors;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (!lengths[i].rejected_because.empty()) continue;
    used.push_back(&lengths[i]);
    acceptance.decisions.push_back(DecideLength(session, lengths, i, axis));
    errors.poses.push_back(acceptance.decisions.back().pose);
  }
  acceptance.count_sentence = CountSentence(used.size());
  if (used.empty()) return acceptance;
  errors.values.resize(static_cast<Eigen::Index>(used.size()));
  for (std::size_t i = 0; i < used.size(); ++i)
    errors.values(static_cast<Eigen::Index>(i)) = used[i]->error_um;
  acceptance.worst = WorstOf(lengths, acceptance.decisions);
  for (const Coordinate& coordinate : kCoordinates)
    AddTrends(errors, coordinate, session.acceptance.coverage_factor, acceptance.trends);
  AddBiasAndSpread(errors, used, acceptance);
  acceptance.repeatability = RepeatabilityOf(errors, used, acceptance.spread_um.value);
  return acceptance;
}

Status RequireUnseenRuler(const Session& session,
                          const std::map<std::string, std::string>& sha256_of_file) {
  std::map<std::string, std::string> calibration;  // hash -> image
  for (const CalibrationImage& image : session.calibration_images)
    if (const auto at = sha256_of_file.find(image.image); at != sha256_of_file.end())
      calibration.emplace(at->second, image.image);
  for (const std::string& image : session.ruler_images) {
    const auto at = sha256_of_file.find(image);
    if (at == sha256_of_file.end()) continue;
    const auto seen = calibration.find(at->second);
    if (seen == calibration.end()) continue;
    return BadInput((session.folder / "ruler.csv").string() + ": the ruler image '" + image +
                    "' has the same bytes as the calibration image '" + seen->second +
                    "' (SHA-256 " + at->second.substr(0, 12) +
                    "…); an image that the calibration used proves nothing: remove it from one of "
                    "the tables");
  }
  return {};
}

}  // namespace telestrain
