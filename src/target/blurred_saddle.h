#pragma once

#include "target/wide_loop.h"

namespace telestrain {

// sgn(d1) sgn(d2), blurred by an isotropic Gaussian: the image of a checkerboard's corner whose two
// edge lines may meet at any angle. With h = d1/s, k = d2/s (signed distances from the lines over
// the blur s) and rho = n1 . n2 (the lines' normals), the blurred value is exactly
//   E = erf(h/sqrt2) erf(k/sqrt2) + 4 int_0^rho phi2(h, k; r) dr
// by the bivariate normal distribution's identity dPhi2/drho = phi2 (Plackett, Biometrika 41,
// 1954). The product alone is right for perpendicular lines only.
struct SaddleBlock {
  float value[kBlock];   // E
  float by_h[kBlock];    // dE/dh = 2 phi(h) erf((k - rho h) / sqrt(2 (1 - rho^2)))
  float by_k[kBlock];    // dE/dk
  float by_rho[kBlock];  // dE/drho = 4 phi2(h, k; rho)
};

// The saddle for one pair of lines. Cheap to make.
class BlurredSaddle {
 public:
  // Beyond this many blurs from a line its profile is taken as saturated (error 7e-6).
  static constexpr double kReach = 4.5;

  // |rho| <= 0.99.
  explicit BlurredSaddle(double rho);

  // At kBlock points. Errors below 2e-6.
  void Evaluate(const float* h, const float* k, SaddleBlock* at) const;

 private:
  static constexpr int kNodes = 4;
  struct Coefficients {
    float rho;
    float inverse_width;  // 1 / sqrt(1 - rho^2)
    // Gauss-Legendre in t = asin(r): sin t, 1 / (2 cos^2 t) and the weight with 4 / (2 pi).
    float sine[kNodes], half_inverse_cosine2[kNodes], weight[kNodes];
  };
  static void Fill(const Coefficients& coefficients, const float* h, const float* k,
                   SaddleBlock* at);

  Coefficients coefficients_;
};

}  // namespace telestrain
