#include "measurement/ruler.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/csv.h"
#include "base/numbers.h"
#include "measurement/triangulation.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;

// Half the epipolar error of a cross beyond which one of its views saw something else: this, or as
// many standard deviations of the cross where those are larger (the residual's own is 1 / sqrt 2 of
// a cross's).
constexpr double kMaxResidual_px = 0.5;
constexpr double kMaxResidual_sigmas = 4;

// What the views of one group measured of one cross.
struct RulerEnd {
  std::vector<ViewMeasurement> measurements;
  std::string missing;  // reasons of the views that lack it
};

RulerEnd CollectEnd(const Session& session, const std::vector<CrossObservation>& crosses,
                    const std::string& image, const std::string& group) {
  RulerEnd end;
  for (std::size_t v = 0; v < session.views.size(); ++v) {
    if (session.views[v].group != group) continue;
    const auto at = std::find_if(crosses.begin(), crosses.end(), [&](const CrossObservation& c) {
      return c.image == image && c.view == session.views[v].name;
    });
    if (at != crosses.end() && at->center)
      end.measurements.push_back(
          {static_cast<int>(v), at->center->pixel, at->center->covariance_px2});
    else
      end.missing += (end.missing.empty() ? "" : "; ") + session.views[v].name + ": " +
                     (at == crosses.end() ? "not searched" : at->rejected_because);
  }
  return end;
}

double AllowedResidual_px(const RulerEnd& end) {
  double allowed_px = kMaxResidual_px;
  for (const ViewMeasurement& measurement : end.measurements)
    allowed_px = std::max(
        allowed_px, kMaxResidual_sigmas * std::sqrt(0.5 * measurement.covariance_px2.trace()));
  return allowed_px;
}

// Why an end is not measured; empty when it is.
std::string DisagreementOf(const RulerEnd& end, const TriangulatedPoint& point) {
  const double allowed_px = AllowedResidual_px(end);
  if (point.residual_px <= allowed_px) return "";
  return "the views do not agree on a cross: " + FormatFixed(point.residual_px, 2) +
         " px off the epipolar line, " + FormatFixed(allowed_px, 2) + " px allowed";
}

double Length_mm(const ArrayCalibration& array, const RulerEnd& a, const RulerEnd& b) {
  return (Triangulate(array, b.measurements).in_array_mm -
          Triangulate(array, a.measurements).in_array_mm)
      .norm();
}

std::vector<BudgetLine> Budget_um(const Session& session, const ArrayCalibration& array,
                                  const RulerEnd& a, const RulerEnd& b) {
  const TriangulatedPoint end_a = Triangulate(array, a.measurements);
  const TriangulatedPoint end_b = Triangulate(array, b.measurements);
  const Eigen::Vector3d span = end_b.in_array_mm - end_a.in_array_mm;
  const Eigen::Vector3d direction = span.normalized();
  const double corner_part =
      std::sqrt(direction.dot((end_a.covariance_mm2 + end_b.covariance_mm2) * direction));
  const CalibrationParts calibration =
      CalibrationPart(array, [&](const ArrayCalibration& moved) { return Length_mm(moved, a, b); });
  return {{kCrossPositions, 1000 * corner_part},
          {kCalibrationNoise, 1000 * calibration.noise},
          {kTargetCertificate, 1000 * calibration.certificate},
          {kRulerCertificate, session.ruler.sigma_length_um}};
}

RulerLength MeasureOne(const Session& session, const ArrayCalibration& array,
                       const std::vector<CrossObservation>& crosses, const std::string& image) {
  RulerLength length;
  length.image = image;
  const std::vector<std::string> groups = session.Groups();
  if (groups.size() < 2) {
    length.rejected_because = "the session has one group of views, a ruler needs two";
    return length;
  }
  const RulerEnd a = CollectEnd(session, crosses, image, groups[0]);
  const RulerEnd b = CollectEnd(session, crosses, image, groups[1]);
  if (a.measurements.size() < 2 || b.measurements.size() < 2) {
    const std::string why =
        a.missing + (a.missing.empty() || b.missing.empty() ? "" : "; ") + b.missing;
    length.rejected_because = why.empty() ? "a group has fewer than two views" : why;
    return length;
  }
  const TriangulatedPoint end_a = Triangulate(array, a.measurements);
  const TriangulatedPoint end_b = Triangulate(array, b.measurements);
  length.end_a_in_array_mm = end_a.in_array_mm;
  length.end_b_in_array_mm = end_b.in_array_mm;
  length.residual_px = std::max(end_a.residual_px, end_b.residual_px);
  length.rejected_because = DisagreementOf(a, end_a);
  if (length.rejected_because.empty()) length.rejected_because = DisagreementOf(b, end_b);
  if (!length.rejected_because.empty()) return length;
  length.length_mm = (end_b.in_array_mm - end_a.in_array_mm).norm();
  length.error_um = 1000 * (length.length_mm - session.ruler.length_mm);
  length.budget = Budget_um(session, array, a, b);
  length.standard_uncertainty_um = Combine(length.budget);
  return length;
}

// Root mean square of every budget line over the images.
Json MeanBudget(const std::vector<RulerLength>& lengths) {
  std::vector<BudgetLine> mean;
  int count = 0;
  for (const RulerLength& length : lengths) {
    if (!length.rejected_because.empty()) continue;
    if (mean.empty()) mean.resize(length.budget.size());
    for (std::size_t i = 0; i < mean.size(); ++i) {
      const double u = length.budget[i].standard_uncertainty;
      mean[i].source = length.budget[i].source;
      mean[i].standard_uncertainty += u * u;
    }
    ++count;
  }
  Json budget = Json::array();
  for (const BudgetLine& line : mean)
    budget.push_back({{"source", line.source},
                      {"standard_uncertainty_um", std::sqrt(line.standard_uncertainty / count)}});
  return budget;
}

}  // namespace

std::vector<RulerLength> MeasureRuler(const Session& session, const ArrayCalibration& array,
                                      const std::vector<CrossObservation>& crosses) {
  std::vector<RulerLength> lengths;
  for (const std::string& image : session.ruler_images)
    lengths.push_back(MeasureOne(session, array, crosses, image));
  return lengths;
}

RulerSummary Summarise(const std::vector<RulerLength>& lengths) {
  RulerSummary summary;
  for (const RulerLength& length : lengths) {
    if (!length.rejected_because.empty()) continue;
    ++summary.count;
    summary.mean_error_um += length.error_um;
    summary.max_abs_error_um = std::max(summary.max_abs_error_um, std::abs(length.error_um));
  }
  if (summary.count == 0) return summary;
  summary.mean_error_um /= summary.count;
  double squares = 0;
  for (const RulerLength& length : lengths)
    if (length.rejected_because.empty())
      squares += std::pow(length.error_um - summary.mean_error_um, 2);
  if (summary.count > 1) summary.sd_error_um = std::sqrt(squares / (summary.count - 1));
  return summary;
}

std::string RulerCsv(const std::vector<RulerLength>& lengths) {
  std::string text = "image,length_mm,error_um,standard_uncertainty_um\n";
  for (const RulerLength& length : lengths)
    if (length.rejected_because.empty())
      text +=
          CsvLine({length.image, FormatFixed(length.length_mm, 7), FormatFixed(length.error_um, 4),
                   FormatFixed(length.standard_uncertainty_um, 4)});
  return text;
}

nlohmann::ordered_json RulerJson(const Session& session, const std::vector<RulerLength>& lengths,
                                 const std::map<std::string, std::string>& made_from) {
  const auto point = [](const Eigen::Vector3d& p) { return Json::array({p.x(), p.y(), p.z()}); };
  Json images = Json::array();
  for (const RulerLength& length : lengths) {
    if (!length.rejected_because.empty()) {
      images.push_back({{"image", length.image}, {"rejected_because", length.rejected_because}});
      continue;
    }
    images.push_back({{"image", length.image},
                      {"length_mm", length.length_mm},
                      {"error_um", length.error_um},
                      {"standard_uncertainty_um", length.standard_uncertainty_um},
                      {"residual_px", length.residual_px},
                      {"ends_in_array_mm", Json::array({point(length.end_a_in_array_mm),
                                                        point(length.end_b_in_array_mm)})}});
  }
  const RulerSummary summary = Summarise(lengths);
  return {{"schema", kRulerSchema},
          {"made_from", made_from},
          {"nominal_length_mm", session.ruler.length_mm},
          {"images", images},
          {"summary",
           {{"count", summary.count},
            {"mean_error_um", summary.mean_error_um},
            {"sd_error_um", summary.sd_error_um},
            {"max_abs_error_um", summary.max_abs_error_um}}},
          {"budget", MeanBudget(lengths)}};
}

}  // namespace telestrain
