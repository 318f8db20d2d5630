#include "calibration/corner_gram.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace telestrain {
namespace {

// Two doubles at once: a plain SSE2 or NEON register, so that no byte depends on the processor.
using Lanes [[gnu::vector_size(16)]] = double;
constexpr int kLanes = 2;

Lanes Load(const double* from) {
  Lanes value;
  std::memcpy(&value, from, sizeof(value));
  return value;
}
void Store(const Lanes& value, double* to) { std::memcpy(to, &value, sizeof(value)); }

// What the lens makes of some corners.
struct Imaged {
  Lanes x{}, y{}, r2{};     // ideal, mm
  Lanes depth{}, shrink{};  // shrink = 1 / (1 + telecentricity depth)
  Lanes distorted_x{}, distorted_y{};
  Lanes residual_u{}, residual_v{};  // whitened
};

Lanes Row(const ImageFromBasis& image, int row, bool curved, const CornerArrays& corners, int at) {
  Lanes value = image(row, 0) + image(row, 1) * Load(corners[CornerArrays::kX] + at) +
                image(row, 2) * Load(corners[CornerArrays::kY] + at);
  if (curved)
    value += image(row, 3) * Load(corners[CornerArrays::kCurveX] + at) +
             image(row, 4) * Load(corners[CornerArrays::kCurveY] + at);
  return value;
}

Imaged Image(const CornerArrays& corners, const GramPlan& plan, const LensNumbers& lens,
             const ImageFromBasis& image, int at) {
  Imaged i;
  i.x = Row(image, 0, plan.curved, corners, at);
  i.y = Row(image, 1, plan.curved, corners, at);
  if (plan.depth) {
    i.depth = Row(image, 2, plan.curved, corners, at);
    i.shrink = 1.0 / (1.0 + lens.telecentricity_per_mm * i.depth);
    i.x *= i.shrink;
    i.y *= i.shrink;
  }
  const Lanes xx = i.x * i.x, yy = i.y * i.y, xy = 2.0 * i.x * i.y;
  i.r2 = xx + yy;
  const Lanes radial = 1.0 + i.r2 * (lens.k1 + i.r2 * (lens.k2 + i.r2 * lens.k3));
  i.distorted_x = i.x * radial + lens.p1 * xy + lens.p2 * (i.r2 + 2.0 * xx);
  i.distorted_y = i.y * radial + lens.p1 * (i.r2 + 2.0 * yy) + lens.p2 * xy;
  const double m = lens.magnification_px_per_mm;
  const Lanes du = lens.center_px.x() + m * i.distorted_x - Load(corners[CornerArrays::kU] + at);
  const Lanes dv =
      lens.center_px.y() + m * lens.aspect * i.distorted_y - Load(corners[CornerArrays::kV] + at);
  i.residual_u =
      Load(corners[CornerArrays::kW00] + at) * du + Load(corners[CornerArrays::kW01] + at) * dv;
  i.residual_v =
      Load(corners[CornerArrays::kW10] + at) * du + Load(corners[CornerArrays::kW11] + at) * dv;
  return i;
}

// Writes a column's two rows of some corners.
class ColumnWriter {
 public:
  ColumnWriter(double* columns, int padded, int at) : next_(columns + at), padded_(padded) {}
  void Write(const Lanes& u, const Lanes& v) {
    Store(u, next_);
    Store(v, next_ + padded_);
    next_ += 2 * padded_;
  }

 private:
  double* next_;
  int padded_;
};

// Derivative of the whitened pixel by the image before the lens: 2 x (x, y, depth).
struct PixelByImage {
  Lanes ux{}, uy{}, ud{}, vx{}, vy{}, vd{};
};

PixelByImage Derivative(const CornerArrays& corners, const GramPlan& plan, const LensNumbers& lens,
                        const Imaged& i, int at) {
  const Lanes radial = 1.0 + i.r2 * (lens.k1 + i.r2 * (lens.k2 + i.r2 * lens.k3));
  const Lanes slope = 2.0 * (lens.k1 + i.r2 * (2.0 * lens.k2 + 3.0 * lens.k3 * i.r2));
  const Lanes jxx = radial + slope * i.x * i.x + 2.0 * lens.p1 * i.y + 6.0 * lens.p2 * i.x;
  const Lanes jxy = slope * i.x * i.y + 2.0 * lens.p1 * i.x + 2.0 * lens.p2 * i.y;
  const Lanes jyy = radial + slope * i.y * i.y + 6.0 * lens.p1 * i.y + 2.0 * lens.p2 * i.x;
  const double mx = lens.magnification_px_per_mm, my = mx * lens.aspect;
  const Lanes w00 = mx * Load(corners[CornerArrays::kW00] + at);
  const Lanes w01 = my * Load(corners[CornerArrays::kW01] + at);
  const Lanes w10 = mx * Load(corners[CornerArrays::kW10] + at);
  const Lanes w11 = my * Load(corners[CornerArrays::kW11] + at);
  PixelByImage d;
  d.ux = w00 * jxx + w01 * jxy;
  d.uy = w00 * jxy + w01 * jyy;
  d.vx = w10 * jxx + w11 * jxy;
  d.vy = w10 * jxy + w11 * jyy;
  if (plan.depth) {
    for (Lanes* value : {&d.ux, &d.uy, &d.vx, &d.vy}) *value *= i.shrink;
    d.ud = -lens.telecentricity_per_mm * (d.ux * i.x + d.uy * i.y);
    d.vd = -lens.telecentricity_per_mm * (d.vx * i.x + d.vy * i.y);
  }
  return d;
}

void WriteImageColumns(const CornerArrays& corners, const GramPlan& plan, const PixelByImage& d,
                       int at, ColumnWriter& writer) {
  const Lanes x = Load(corners[CornerArrays::kX] + at), y = Load(corners[CornerArrays::kY] + at);
  const Lanes curve_x = Load(corners[CornerArrays::kCurveX] + at);
  const Lanes curve_y = Load(corners[CornerArrays::kCurveY] + at);
  const auto write = [&](const Lanes& u, const Lanes& v) {
    writer.Write(u, v);
    writer.Write(u * x, v * x);
    writer.Write(u * y, v * y);
    if (!plan.curved) return;
    writer.Write(u * curve_x, v * curve_x);
    writer.Write(u * curve_y, v * curve_y);
  };
  write(d.ux, d.vx);
  write(d.uy, d.vy);
  if (plan.depth) write(d.ud, d.vd);
}

void WriteLensColumns(const CornerArrays& corners, const GramPlan& plan, const LensNumbers& lens,
                      const Imaged& i, const PixelByImage& d, int at, ColumnWriter& writer) {
  constexpr double kUnit = 1 / kScaleRadius_mm;
  const Lanes w00 = Load(corners[CornerArrays::kW00] + at);
  const Lanes w01 = Load(corners[CornerArrays::kW01] + at);
  const Lanes w10 = Load(corners[CornerArrays::kW10] + at);
  const Lanes w11 = Load(corners[CornerArrays::kW11] + at);
  const double mx = lens.magnification_px_per_mm, my = mx * lens.aspect;
  const auto write = [&](const Lanes& u, const Lanes& v) {
    writer.Write(w00 * u + w01 * v, w10 * u + w11 * v);
  };
  const Lanes s2 = i.r2 * (kUnit * kUnit);
  const Lanes x = mx * i.x, y = my * i.y, cross = (2 * kUnit) * i.x * i.y;
  const auto& free = plan.lens_free;
  if (free[0])
    write(lens.unit_px_per_mm * i.distorted_x, lens.unit_px_per_mm * lens.aspect * i.distorted_y);
  if (free[1]) write(Lanes{}, mx * i.distorted_y);
  if (free[2]) write(s2 * x, s2 * y);
  if (free[3]) write(s2 * s2 * x, s2 * s2 * y);
  if (free[4]) write(mx * cross, my * kUnit * (i.r2 + 2.0 * i.y * i.y));
  if (free[5]) write(mx * kUnit * (i.r2 + 2.0 * i.x * i.x), my * cross);
  if (free[6]) write(s2 * s2 * s2 * x, s2 * s2 * s2 * y);
  if (free[7])
    writer.Write(-i.depth * (d.ux * i.x + d.uy * i.y), -i.depth * (d.vx * i.x + d.vy * i.y));
}

// Cauchy's loss of the squared length of a corner's whitened residual, and its derivative.
struct Loss {
  double value = 0, weight = 1;
};
Loss CauchyLoss(double squared, double scale) {
  const double c2 = scale * scale;
  return {c2 * std::log1p(squared / c2), 1 / (1 + squared / c2)};
}

// Columns of [J r], `stride` apart, and what the losses exceed the weighted squares by.
struct Columns {
  std::vector<double>& values;
  int count, stride;
  double extra = 0;
  double* operator[](int column) { return values.data() + column * stride; }
};

void WeighByLoss(double scale, int padded, Columns& columns) {
  const double* residual = columns[columns.count - 1];
  std::vector<double> root(static_cast<std::size_t>(padded));
  for (int i = 0; i < padded; ++i) {
    const double squared = residual[i] * residual[i] + residual[padded + i] * residual[padded + i];
    const Loss loss = CauchyLoss(squared, scale);
    root[static_cast<std::size_t>(i)] = std::sqrt(loss.weight);
    columns.extra += loss.value - loss.weight * squared;  // never negative: the loss is concave
  }
  for (int c = 0; c < columns.count; ++c)
    for (int i = 0; i < padded; ++i) {
      columns[c][i] *= root[static_cast<std::size_t>(i)];
      columns[c][padded + i] *= root[static_cast<std::size_t>(i)];
    }
}

Columns FillColumns(const CornerArrays& corners, const GramPlan& plan, const LensNumbers& lens,
                    const ImageFromBasis& image) {
  // One buffer per thread: every byte that is read was written before in the same call.
  thread_local std::vector<double> buffer;
  const int padded = corners.Padded();
  Columns columns{buffer, plan.ColumnCount(), 2 * padded};
  buffer.resize(std::max(buffer.size(), static_cast<std::size_t>(columns.count * columns.stride)));
  for (int at = 0; at < padded; at += kLanes) {
    const Imaged imaged = Image(corners, plan, lens, image, at);
    const PixelByImage derivative = Derivative(corners, plan, lens, imaged, at);
    ColumnWriter writer(buffer.data(), padded, at);
    WriteImageColumns(corners, plan, derivative, at, writer);
    WriteLensColumns(corners, plan, lens, imaged, derivative, at, writer);
    writer.Write(imaged.residual_u, imaged.residual_v);
  }
  if (plan.robust_sigmas > 0) WeighByLoss(plan.robust_sigmas, padded, columns);
  return columns;
}

// Scalar products of one column with `kCount` others, each summed in the same fixed order.
template <int kCount>
void Products(const double* a, const double* b, int stride, double* products) {
  Lanes even[kCount] = {}, odd[kCount] = {};
  for (int i = 0; i < stride; i += 2 * kLanes) {
    const Lanes a0 = Load(a + i), a1 = Load(a + i + kLanes);
    for (int k = 0; k < kCount; ++k) {
      even[k] += a0 * Load(b + k * stride + i);
      odd[k] += a1 * Load(b + k * stride + i + kLanes);
    }
  }
  for (int k = 0; k < kCount; ++k) {
    const Lanes sum = even[k] + odd[k];
    products[k] = sum[0] + sum[1];
  }
}

GramFactor GramOf(Columns& columns) {
  const int n = columns.count;
  GramFactor gram = GramFactor::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    int j = i;
    for (; j + 4 <= n; j += 4) Products<4>(columns[i], columns[j], columns.stride, &gram(i, j));
    for (; j < n; ++j) Products<1>(columns[i], columns[j], columns.stride, &gram(i, j));
  }
  return gram;
}

// Cholesky's factor of [J r]^T [J r], its columns taken in the order of what is left of them: the
// magnification's column is a combination of the others for a perfect lens, and without pivoting
// rounding would grow through such columns by their smallness. What rounding alone can explain
// stands for all that it may hide, with its part of the gradient: without that the solver's
// gradient would be wrong and it would stop too early. `extra` lengthens the last column.
GramFactor PivotedFactor(double extra, const GramFactor& gram) {
  constexpr double kRounding = 1e-14;  // of the column's own square: 45 times the precision
  const Eigen::Index n = gram.rows();
  if (!gram.allFinite()) return GramFactor::Constant(n, n, gram.sum());
  GramFactor left = gram.selfadjointView<Eigen::Upper>();
  GramFactor factor = GramFactor::Zero(n, n);
  Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, kMaxColumns> weight(n);
  for (Eigen::Index i = 0; i < n; ++i) weight(i) = left(i, i) > 0 ? 1 / left(i, i) : 0;
  weight(n - 1) = 0;
  Eigen::Index row = 0, pivot = 0;
  for (; row + 1 < n; ++row) {
    const double share = (left.diagonal().transpose().array() * weight.array()).maxCoeff(&pivot);
    if (!(share > kRounding)) break;
    factor.row(row) = left.row(pivot) / std::sqrt(left(pivot, pivot));
    left.noalias() -= factor.row(row).transpose() * factor.row(row);
    left.row(pivot).setZero();
    left.col(pivot).setZero();
    weight(pivot) = 0;
  }
  for (Eigen::Index column = 0; column + 1 < n; ++column) {
    if (weight(column) == 0) continue;
    factor(row, column) = std::sqrt(kRounding / weight(column));
    // What rounding leaves must not make the last column longer than it is.
    const double room = std::sqrt(std::max(left(n - 1, n - 1), 0.0));
    factor(row, n - 1) = std::clamp(left(column, n - 1) / factor(row, column), -room, room);
    left(n - 1, n - 1) -= factor(row, n - 1) * factor(row, n - 1);
    ++row;
  }
  factor(n - 1, n - 1) = std::sqrt(std::max(left(n - 1, n - 1), 0.0) + extra);
  return factor;
}

}  // namespace

int GramPlan::LensCount() const {
  return static_cast<int>(std::count(lens_free.begin(), lens_free.end(), true));
}

double LossOfBoard(const CornerArrays& corners, const GramPlan& plan, const LensNumbers& lens,
                   const ImageFromBasis& image) {
  Lanes sum = {};
  double robust = 0;
  for (int at = 0; at < corners.Padded(); at += kLanes) {
    const Imaged i = Image(corners, plan, lens, image, at);
    const Lanes squared = i.residual_u * i.residual_u + i.residual_v * i.residual_v;
    sum += squared;
    if (plan.robust_sigmas > 0)
      robust += CauchyLoss(squared[0], plan.robust_sigmas).value +
                CauchyLoss(squared[1], plan.robust_sigmas).value;
  }
  return plan.robust_sigmas > 0 ? robust : sum[0] + sum[1];
}

GramFactor FactorOfBoard(const CornerArrays& corners, const GramPlan& plan, const LensNumbers& lens,
                         const ImageFromBasis& image) {
  Columns columns = FillColumns(corners, plan, lens, image);
  return PivotedFactor(columns.extra, GramOf(columns));
}

Eigen::MatrixXd ColumnsOfBoard(const CornerArrays& corners, const GramPlan& plan,
                               const LensNumbers& lens, const ImageFromBasis& image) {
  Columns columns = FillColumns(corners, plan, lens, image);
  return Eigen::Map<const Eigen::MatrixXd>(columns[0], columns.stride, columns.count);
}

}  // namespace telestrain
