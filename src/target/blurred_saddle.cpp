#include "target/blurred_saddle.h"

#include <array>
#include <cmath>
#include <numbers>

#include "base/check.h"

namespace telestrain {

// erf(x/sqrt2) and the normal density on a grid; cubic Hermite interpolation between the nodes has
// an error below step^4 / 384 * max|f''''| = 1e-9.
class NormalTable {
 public:
  struct Pair {
    double erf = 0;
    double density = 0;
  };

  static const NormalTable& Get() {
    static const NormalTable table;
    return table;
  }

  Pair At(double x) const {
    const double magnitude = std::min(std::abs(x), kEnd);
    const double scaled = magnitude * kStepsPerUnit;
    const auto node = static_cast<std::size_t>(scaled);
    const double t = scaled - static_cast<double>(node);
    const Node& a = nodes_[node];
    const Node& b = nodes_[node + 1];
    const double u = 1 - t;
    const double from_a = u * u * (1 + 2 * t), from_b = t * t * (1 + 2 * u);
    const double slope_a = t * u * u, slope_b = -t * t * u;
    const double erf =
        from_a * a.erf + from_b * b.erf + slope_a * a.erf_slope + slope_b * b.erf_slope;
    const double density = from_a * a.density + from_b * b.density + slope_a * a.density_slope +
                           slope_b * b.density_slope;
    return {std::copysign(erf, x), density};
  }

 private:
  static constexpr double kEnd = 7.0;
  static constexpr double kStepsPerUnit = 64.0;
  struct Node {
    double erf, erf_slope, density, density_slope;  // slopes per step
  };

  NormalTable() {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const double x = static_cast<double>(i) / kStepsPerUnit;
      const double density = std::exp(-0.5 * x * x) / std::sqrt(2 * std::numbers::pi);
      nodes_[i] = {std::erf(x / std::numbers::sqrt2), 2 * density / kStepsPerUnit, density,
                   -x * density / kStepsPerUnit};
    }
  }

  std::array<Node, static_cast<std::size_t>(kEnd* kStepsPerUnit) + 2> nodes_;
};

BlurredSaddle::BlurredSaddle(double rho) : table_(&NormalTable::Get()), rho_(rho) {
  TELESTRAIN_CHECK(std::abs(rho) <= 0.99, "the two lines are nearly parallel");
  inverse_width_ = 1 / std::sqrt(1 - rho * rho);
  constexpr double kAbscissa[kNodes] = {-0.8611363115940526, -0.3399810435848563,
                                        0.3399810435848563, 0.8611363115940526};
  constexpr double kWeight[kNodes] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                      0.3478548451374538};
  const double half_range = 0.5 * std::asin(rho);
  for (int i = 0; i < kNodes; ++i) {
    const double t = half_range * (1 + kAbscissa[i]);
    sine_[i] = std::sin(t);
    half_inverse_cosine2_[i] = 0.5 / (std::cos(t) * std::cos(t));
    weight_[i] = kWeight[i] * half_range * 2 / std::numbers::pi;
  }
}

double BlurredSaddle::CrossTerm(double h, double k) const {
  const double squares = h * h + k * k;
  const double twice_product = 2 * h * k;
  double sum = 0;
  for (int i = 0; i < kNodes; ++i)
    sum += weight_[i] * std::exp(-(squares - twice_product * sine_[i]) * half_inverse_cosine2_[i]);
  return sum;
}

SaddleValue BlurredSaddle::Evaluate(double h, double k) const {
  const NormalTable& table = *table_;
  if (std::abs(k) > kReach) {
    const auto edge = table.At(h);
    const double sign = k > 0 ? 1 : -1;
    return {sign * edge.erf, 2 * sign * edge.density, 0, 0};
  }
  if (std::abs(h) > kReach) {
    const auto edge = table.At(k);
    const double sign = h > 0 ? 1 : -1;
    return {sign * edge.erf, 0, 2 * sign * edge.density, 0};
  }
  const auto along_h = table.At(h);
  const auto along_k = table.At(k);
  const auto k_given_h = table.At((k - rho_ * h) * inverse_width_);
  const auto h_given_k = table.At((h - rho_ * k) * inverse_width_);
  SaddleValue saddle;
  saddle.value = along_h.erf * along_k.erf;
  saddle.by_h = 2 * along_h.density * k_given_h.erf;
  saddle.by_k = 2 * along_k.density * h_given_k.erf;
  saddle.by_rho = 4 * along_h.density * k_given_h.density * inverse_width_;
  if (std::abs(rho_) > 1e-6) saddle.value += CrossTerm(h, k);
  return saddle;
}

}  // namespace telestrain
