#include "target/edge_strip.h"

#include <array>

namespace telestrain {
namespace {

// Along the line nothing depends on the place, so x0 and y0 share the row `slope`.
enum Row { kOne, kX, kY, kProfile, kProfileX, kProfileY, kSlope, kSlopeTurn, kSlopeH, kResidual };
constexpr int kRows = kResidual + 1;

struct Coefficients {
  float linear[6];
  float center[2], normal[2], turned[2];  // the normals over the blur
};

struct Block {
  const float *x, *y, *gray, *side;
};

TELESTRAIN_WIDE void FillRows(const Coefficients& coefficients, const Block& block,
                              float (*__restrict rows)[kBlock]) {
  const Coefficients c = coefficients;
  const float* __restrict x_of = block.x;
  const float* __restrict y_of = block.y;
  const float* __restrict gray_of = block.gray;
  const float* __restrict side_of = block.side;
  for (int i = 0; i < kBlock; ++i) {
    const float x = x_of[i], y = y_of[i], side = side_of[i], weight = side * side;
    const float dx = x - c.center[0], dy = y - c.center[1];
    const float h = c.normal[0] * dx + c.normal[1] * dy;
    const EdgeProfile edge = EdgeProfileAt(h);
    const float profile = side * edge.erf;
    const float contrast = c.linear[3] + c.linear[4] * x + c.linear[5] * y;
    const float slope = contrast * side * 0.797884561F * edge.gauss;  // 2 phi
    const float model = c.linear[0] + c.linear[1] * x + c.linear[2] * y + contrast * profile;
    rows[kOne][i] = weight;
    rows[kX][i] = x;
    rows[kY][i] = y;
    rows[kProfile][i] = profile;
    rows[kProfileX][i] = profile * x;
    rows[kProfileY][i] = profile * y;
    rows[kSlope][i] = slope;
    rows[kSlopeTurn][i] = slope * (c.turned[0] * dx + c.turned[1] * dy);
    rows[kSlopeH][i] = slope * h;
    rows[kResidual][i] = weight * (gray_of[i] - model);
  }
}

}  // namespace

EdgeStrip::Sums EdgeStrip::At(const Line& line, const Eigen::Matrix<double, 6, 1>& linear) const {
  Coefficients c;
  for (int i = 0; i < 6; ++i) c.linear[i] = static_cast<float>(linear[i]);
  for (int i = 0; i < 2; ++i) {
    c.center[i] = static_cast<float>(line.center_px[i]);
    c.normal[i] = static_cast<float>(line.normal[i] * line.inverse_blur);
    c.turned[i] = static_cast<float>(line.turned_normal[i] * line.inverse_blur);
  }
  BlockSums products(kRows);
  BlockSums::Rows rows;
  for (int b = 0; b < pixels_.Blocks(); ++b) {
    const int first = b * kBlock;
    FillRows(c,
             {pixels_.x.data() + first, pixels_.y.data() + first, pixels_.gray.data() + first,
              pixels_.side.data() + first},
             rows);
    products.Add(rows);
  }
  constexpr std::array<int, kColumns> kRowOf{kOne,      kX,     kY,     kProfile,   kProfileX,
                                             kProfileY, kSlope, kSlope, kSlopeTurn, kSlopeH};
  const std::array<double, kColumns> factor{
      1, 1, 1, 1, 1, 1, -line.inverse_blur * line.normal.x(), -line.inverse_blur * line.normal.y(),
      1, -1};
  Sums sums;
  sums.normal.setZero();
  for (std::size_t i = 0; i < kColumns; ++i) {
    for (std::size_t j = i; j < kColumns; ++j)
      sums.normal(static_cast<int>(j), static_cast<int>(i)) =
          factor[i] * factor[j] * products.Product(kRowOf[i], kRowOf[j]);
    sums.gradient[static_cast<int>(i)] = factor[i] * products.Product(kRowOf[i], kResidual);
  }
  sums.cost = products.Product(kResidual, kResidual);
  return sums;
}

}  // namespace telestrain
