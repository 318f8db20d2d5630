#pragma once

#include <Eigen/Core>

namespace telestrain {

class NormalTable;

// sgn(d1) sgn(d2), blurred by an isotropic Gaussian: the image of a checkerboard's corner whose two
// edge lines may meet at any angle. With h = d1/s, k = d2/s (signed distances from the lines over
// the blur s) and rho = n1 . n2 (the lines' normals), the blurred value is exactly
//   E = erf(h/sqrt2) erf(k/sqrt2) + 4 int_0^rho phi2(h, k; r) dr
// by the bivariate normal distribution's identity dPhi2/drho = phi2 (Plackett, Biometrika 41,
// 1954). The product alone is right for perpendicular lines only.
struct SaddleValue {
  double value = 0;   // E
  double by_h = 0;    // dE/dh = 2 phi(h) erf((k - rho h) / sqrt(2 (1 - rho^2)))
  double by_k = 0;    // dE/dk
  double by_rho = 0;  // dE/drho = 4 phi2(h, k; rho)
};

// The saddle for one pair of lines. Cheap to make and to evaluate (10 to 60 ns).
class BlurredSaddle {
 public:
  // Beyond this many blurs from a line its profile is taken as saturated (error 7e-6).
  static constexpr double kReach = 4.5;

  // |rho| <= 0.99.
  explicit BlurredSaddle(double rho);

  // Errors below 1e-6; farther than the reach from one line, the other line's edge alone.
  SaddleValue Evaluate(double h, double k) const;

 private:
  static constexpr int kNodes = 4;
  double CrossTerm(double h, double k) const;

  const NormalTable* table_;
  double rho_;
  double inverse_width_;  // 1 / sqrt(1 - rho^2)
  // Gauss-Legendre in t = asin(r): sin t, 1 / (2 cos^2 t) and the weight with 4 / (2 pi).
  double sine_[kNodes], half_inverse_cosine2_[kNodes], weight_[kNodes];
};

}  // namespace telestrain
