#include "correlation/field_summary.h"

#include <cmath>
#include <limits>
#include <vector>

#include "base/numbers.h"

namespace telestrain {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double MedianOrNone(std::vector<double> values) {
  return values.empty() ? kNone : Median(std::move(values));
}

double MeanOrNone(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? kNone : sum / static_cast<double>(values.size());
}

// `number` of every point that converged and has it.
template <class Number>
std::vector<double> Numbers(const CorrelationField& field, const Number& number) {
  std::vector<double> numbers;
  numbers.reserve(field.points.size());
  for (const FieldPoint& point : field.points) {
    if (!point.match.ok()) continue;
    if (const double value = number(point); std::isfinite(value)) numbers.push_back(value);
  }
  return numbers;
}

bool HasStrain(const FieldPoint& point) { return point.match.ok() && point.strain.allFinite(); }

}  // namespace

FieldSummary Summarize(const CorrelationField& field) {
  FieldSummary summary;
  summary.points = field.points.size();
  for (const FieldPoint& point : field.points) {
    ++summary.count_of_status.at(static_cast<std::size_t>(point.match.status));
    if (HasStrain(point)) ++summary.points_with_strain;
  }
  for (const int axis : {0, 1}) {
    summary.mean_displacement_px[axis] = MeanOrNone(
        Numbers(field, [=](const FieldPoint& p) { return p.match.shape.displacement_px[axis]; }));
    summary.median_sigma_px[axis] = MedianOrNone(Numbers(
        field, [=](const FieldPoint& p) { return std::sqrt(p.match.covariance(axis, axis)); }));
    for (const int other : {0, 1})
      summary.mean_strain(axis, other) =
          MeanOrNone(Numbers(field, [=](const FieldPoint& p) { return p.strain(axis, other); }));
  }
  for (const int part : {0, 1, 2})
    summary.median_sigma_strain[part] = MedianOrNone(Numbers(
        field, [=](const FieldPoint& p) { return HasStrain(p) ? p.sigma_strain[part] : kNone; }));
  summary.median_sigma_gray =
      MedianOrNone(Numbers(field, [](const FieldPoint& p) { return p.match.sigma_gray; }));
  summary.median_zncc =
      MedianOrNone(Numbers(field, [](const FieldPoint& p) { return p.match.zncc; }));
  return summary;
}

}  // namespace telestrain
