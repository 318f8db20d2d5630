#include "target/edge_strip.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace telestrain {
namespace {

constexpr int kLanes = 8;
constexpr int kBlock = 64;
constexpr int kRows = EdgeStrip::kColumns + 1;  // and the residual

// Two versions of a loop, the same operations in the same order; the processor chooses.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define TELESTRAIN_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define TELESTRAIN_WIDE
#endif

// Inputs and rows of the Jacobian of one block of pixels.
struct Block {
  const double *x, *y, *gray, *side, *weight;
  double rows[kRows][kBlock];
};

struct Coefficients {
  double linear[6];
  double center[2], normal[2], turned[2];
  double scale;
};

// exp(a) for -50 < a <= 0, relative error 1e-9.
inline __attribute__((always_inline)) double SmallExp(double a) {
  constexpr double kMagic = 6755399441055744.0;  // its last bits hold the rounded number
  const double shifted = a * 1.4426950408889634 + kMagic;
  const double t = a - (shifted - kMagic) * 0.6931471805599453;
  const double series =
      1 + t * (1 + t * (1.0 / 2 +
                        t * (1.0 / 6 +
                             t * (1.0 / 24 +
                                  t * (1.0 / 120 +
                                       t * (1.0 / 720 + t * (1.0 / 5040 + t * (1.0 / 40320))))))));
  const std::int64_t power = (std::bit_cast<std::int64_t>(shifted) + 1023) << 52;
  return series * std::bit_cast<double>(power);
}

// Rows of J and the residual. erf by Abramowitz and Stegun 7.1.26.
TELESTRAIN_WIDE void FillBlock(const Coefficients& coefficients, Block* block) {
  const Coefficients c = coefficients;
  const double* __restrict x_of = block->x;
  const double* __restrict y_of = block->y;
  const double* __restrict gray_of = block->gray;
  const double* __restrict side_of = block->side;
  const double* __restrict weight_of = block->weight;
  double(*__restrict rows)[kBlock] = block->rows;
  for (int i = 0; i < kBlock; ++i) {
    const double x = x_of[i], y = y_of[i], side = side_of[i];
    const double dx = x - c.center[0], dy = y - c.center[1];
    const double h = (c.normal[0] * dx + c.normal[1] * dy) * c.scale;
    const double turn = (c.turned[0] * dx + c.turned[1] * dy) * c.scale;
    const double distance = std::abs(h), magnitude = distance < 9.0 ? distance : 9.0;
    const double gauss = SmallExp(-0.5 * magnitude * magnitude);
    const double t = 1 / (1 + 0.3275911 * 0.7071067811865476 * magnitude);
    const double tail =
        t *
        (0.254829592 +
         t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429)))) *
        gauss;
    const double profile = side * std::copysign(1 - tail, h);
    const double contrast = c.linear[3] + c.linear[4] * x + c.linear[5] * y;
    const double slope = contrast * side * 0.7978845608028654 * gauss;  // 2 phi
    const double weight = weight_of[i];
    const double model = c.linear[0] + c.linear[1] * x + c.linear[2] * y + contrast * profile;
    rows[0][i] = weight;
    rows[1][i] = x;
    rows[2][i] = y;
    rows[3][i] = profile;
    rows[4][i] = profile * x;
    rows[5][i] = profile * y;
    rows[6][i] = -c.scale * c.normal[0] * slope;
    rows[7][i] = -c.scale * c.normal[1] * slope;
    rows[8][i] = slope * turn;
    rows[9][i] = -slope * h;
    rows[10][i] = weight * (gray_of[i] - model);
  }
}

// Adds the block's products of row i with the rows from i on, lane by lane.
TELESTRAIN_WIDE void AddProducts(const Block& block, double (*sums)[kRows][kLanes]) {
  for (int i = 0; i < kRows; ++i)
    for (int j = i; j < kRows; ++j) {
      double lanes[kLanes] = {};
      for (int k = 0; k < kBlock; k += kLanes)
        for (int l = 0; l < kLanes; ++l) lanes[l] += block.rows[i][k + l] * block.rows[j][k + l];
      for (int l = 0; l < kLanes; ++l) sums[i][j][l] += lanes[l];
    }
}

double Total(const double (&l)[kLanes]) {
  return ((l[0] + l[1]) + (l[2] + l[3])) + ((l[4] + l[5]) + (l[6] + l[7]));
}

}  // namespace

void EdgeStrip::Append(double x, double y, double side, const float* gray, int count) {
  const std::size_t first = x_.size(), size = first + static_cast<std::size_t>(count);
  x_.resize(size);
  gray_.resize(size);
  for (int i = 0; i < count; ++i) {
    x_[first + static_cast<std::size_t>(i)] = x + i;
    gray_[first + static_cast<std::size_t>(i)] = static_cast<double>(gray[i]);
  }
  y_.resize(size, y);
  side_.resize(size, side);
  weight_.resize(size, 1);
}

void EdgeStrip::Pad() {
  const std::size_t size = (x_.size() + kBlock - 1) / kBlock * kBlock;
  for (auto* values : {&x_, &y_, &gray_, &side_, &weight_}) values->resize(size, 0);
}

EdgeStrip::Sums EdgeStrip::At(const Line& line, const Eigen::Matrix<double, 6, 1>& linear) const {
  Coefficients c;
  std::copy_n(linear.data(), 6, c.linear);
  for (int i = 0; i < 2; ++i) {
    c.center[i] = line.center_px[i];
    c.normal[i] = line.normal[i];
    c.turned[i] = line.turned_normal[i];
  }
  c.scale = line.inverse_blur;
  double lanes[kRows][kRows][kLanes] = {};
  Block block;
  for (std::size_t first = 0; first < x_.size(); first += kBlock) {
    block.x = &x_[first], block.y = &y_[first], block.gray = &gray_[first];
    block.side = &side_[first], block.weight = &weight_[first];
    FillBlock(c, &block);
    AddProducts(block, lanes);
  }
  Sums sums;
  sums.normal.setZero();
  for (int i = 0; i < kColumns; ++i) {
    for (int j = i; j < kColumns; ++j) sums.normal(j, i) = Total(lanes[i][j]);
    sums.gradient[i] = Total(lanes[i][kColumns]);
  }
  sums.cost = Total(lanes[kColumns][kColumns]);
  return sums;
}

}  // namespace telestrain
