#include "target/edge_crossing.h"

namespace telestrain {
namespace {

constexpr int kResidual = EdgeCrossing::kColumns;

struct Coefficients {
  float linear[6];
  float center[2];
  float u[2], v[2], turned_u[2], turned_v[2];  // over the blur
  float rho_by_u, rho_by_v;
};

struct Block {
  const float *x, *y, *gray, *side;
};

struct Distances {
  float h[kBlock], k[kBlock];
};

TELESTRAIN_WIDE void FillDistances(const Coefficients& coefficients, const Block& block,
                                   Distances* distances) {
  const Coefficients c = coefficients;
  const float* __restrict x_of = block.x;
  const float* __restrict y_of = block.y;
  float* __restrict h = distances->h;
  float* __restrict k = distances->k;
  for (int i = 0; i < kBlock; ++i) {
    const float dx = x_of[i] - c.center[0], dy = y_of[i] - c.center[1];
    h[i] = c.u[0] * dx + c.u[1] * dy;
    k[i] = c.v[0] * dx + c.v[1] * dy;
  }
}

TELESTRAIN_WIDE void FillRows(const Coefficients& coefficients, const Block& block,
                              const Distances& distances, const SaddleBlock& saddle,
                              float (*__restrict rows)[kBlock]) {
  const Coefficients c = coefficients;
  const float* __restrict x_of = block.x;
  const float* __restrict y_of = block.y;
  const float* __restrict gray_of = block.gray;
  const float* __restrict side_of = block.side;
  for (int i = 0; i < kBlock; ++i) {
    const float x = x_of[i], y = y_of[i], weight = side_of[i];
    const float dx = x - c.center[0], dy = y - c.center[1];
    const float value = weight * saddle.value[i];
    const float contrast = weight * (c.linear[3] + c.linear[4] * x + c.linear[5] * y);
    const float by_h = contrast * saddle.by_h[i], by_k = contrast * saddle.by_k[i];
    const float by_rho = contrast * saddle.by_rho[i];
    const float model = c.linear[0] + c.linear[1] * x + c.linear[2] * y + contrast * value;
    rows[0][i] = weight;
    rows[1][i] = x;
    rows[2][i] = y;
    rows[3][i] = value;
    rows[4][i] = value * x;
    rows[5][i] = value * y;
    rows[6][i] = -(by_h * c.u[0] + by_k * c.v[0]);
    rows[7][i] = -(by_h * c.u[1] + by_k * c.v[1]);
    rows[8][i] = by_h * (c.turned_u[0] * dx + c.turned_u[1] * dy) + by_rho * c.rho_by_u;
    rows[9][i] = by_k * (c.turned_v[0] * dx + c.turned_v[1] * dy) + by_rho * c.rho_by_v;
    rows[10][i] = -(by_h * distances.h[i] + by_k * distances.k[i]);
    rows[kResidual][i] = weight * (gray_of[i] - model);
  }
}

void Copy(const Eigen::Vector2d& from, float (&to)[2]) {
  for (int i = 0; i < 2; ++i) to[i] = static_cast<float>(from[i]);
}

Coefficients CoefficientsOf(const EdgeCrossing::Lines& lines,
                            const Eigen::Matrix<double, 6, 1>& linear) {
  Coefficients c;
  for (int i = 0; i < 6; ++i) c.linear[i] = static_cast<float>(linear[i]);
  Copy(lines.center_px, c.center);
  Copy(lines.inverse_blur * lines.normal_u, c.u);
  Copy(lines.inverse_blur * lines.normal_v, c.v);
  Copy(lines.inverse_blur * lines.turned_u, c.turned_u);
  Copy(lines.inverse_blur * lines.turned_v, c.turned_v);
  c.rho_by_u = static_cast<float>(lines.turned_u.dot(lines.normal_v));
  c.rho_by_v = static_cast<float>(lines.turned_v.dot(lines.normal_u));
  return c;
}

}  // namespace

EdgeCrossing::Sums EdgeCrossing::At(const Lines& lines, const BlurredSaddle& saddle,
                                    const Eigen::Matrix<double, 6, 1>& linear) const {
  const Coefficients c = CoefficientsOf(lines, linear);
  BlockSums products(kColumns + 1);
  BlockSums::Rows rows;
  Distances distances;
  SaddleBlock values;
  for (int b = 0; b < pixels_.Blocks(); ++b) {
    const int first = b * kBlock;
    const Block block{pixels_.x.data() + first, pixels_.y.data() + first,
                      pixels_.gray.data() + first, pixels_.side.data() + first};
    FillDistances(c, block, &distances);
    saddle.Evaluate(distances.h, distances.k, &values);
    FillRows(c, block, distances, values, rows);
    products.Add(rows);
  }
  Sums sums;
  sums.normal.setZero();
  for (int i = 0; i < kColumns; ++i) {
    for (int j = i; j < kColumns; ++j) sums.normal(j, i) = products.Product(i, j);
    sums.gradient[i] = products.Product(i, kResidual);
  }
  sums.cost = products.Product(kResidual, kResidual);
  return sums;
}

}  // namespace telestrain
