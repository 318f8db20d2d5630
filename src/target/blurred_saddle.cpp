#include "target/blurred_saddle.h"

#include <cmath>
#include <numbers>

#include "base/check.h"

namespace telestrain {

BlurredSaddle::BlurredSaddle(double rho) {
  TELESTRAIN_CHECK(std::abs(rho) <= 0.99, "the two lines are nearly parallel");
  Coefficients& c = coefficients_;
  c.rho = static_cast<float>(rho);
  c.inverse_width = static_cast<float>(1 / std::sqrt(1 - rho * rho));
  constexpr double kAbscissa[kNodes] = {-0.8611363115940526, -0.3399810435848563,
                                        0.3399810435848563, 0.8611363115940526};
  constexpr double kWeight[kNodes] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                      0.3478548451374538};
  const double half_range = 0.5 * std::asin(rho);
  for (int i = 0; i < kNodes; ++i) {
    const double t = half_range * (1 + kAbscissa[i]);
    c.sine[i] = static_cast<float>(std::sin(t));
    c.half_inverse_cosine2[i] = static_cast<float>(0.5 / (std::cos(t) * std::cos(t)));
    c.weight[i] = static_cast<float>(kWeight[i] * half_range * 2 / std::numbers::pi);
  }
}

TELESTRAIN_WIDE void BlurredSaddle::Fill(const Coefficients& coefficients, const float* h_of,
                                         const float* k_of, SaddleBlock* at) {
  constexpr float kTwoPhi = 0.797884561F, kFourPhi2 = 0.636619772F;  // at 0
  const Coefficients c = coefficients;
  const float* __restrict hs = h_of;
  const float* __restrict ks = k_of;
  SaddleBlock* __restrict out = at;
  for (int i = 0; i < kBlock; ++i) {
    const float h = hs[i], k = ks[i];
    const EdgeProfile along_h = EdgeProfileAt(h), along_k = EdgeProfileAt(k);
    const EdgeProfile k_given_h = EdgeProfileAt((k - c.rho * h) * c.inverse_width);
    const EdgeProfile h_given_k = EdgeProfileAt((h - c.rho * k) * c.inverse_width);
    const float squares = h * h + k * k, twice_product = 2 * h * k;
    float value = along_h.erf * along_k.erf;
    for (int node = 0; node < kNodes; ++node)
      value += c.weight[node] *
               NegativeExp((twice_product * c.sine[node] - squares) * c.half_inverse_cosine2[node]);
    out->value[i] = value;
    out->by_h[i] = kTwoPhi * along_h.gauss * k_given_h.erf;
    out->by_k[i] = kTwoPhi * along_k.gauss * h_given_k.erf;
    out->by_rho[i] = kFourPhi2 * along_h.gauss * k_given_h.gauss * c.inverse_width;
  }
}

void BlurredSaddle::Evaluate(const float* h, const float* k, SaddleBlock* at) const {
  Fill(coefficients_, h, k, at);
}

}  // namespace telestrain
