#include "correlation/subset_moments.h"

#include <cstddef>

#include "correlation/float_vector.h"
#include "correlation/quintic_spline.h"

namespace telestrain::correlation {
namespace {

TELESTRAIN_INLINE const float* RowOf(const float* field, const SubsetView& subset, int row) {
  return field + static_cast<std::ptrdiff_t>(row) * subset.stride;
}

// Offset of column `column` and the seven after it, in half sides.
TELESTRAIN_INLINE Float8 OffsetsFrom(int column, int side_px) {
  const int half = side_px / 2;
  return (LaneNumbers() + static_cast<float>(column - half)) * (1.f / static_cast<float>(half));
}

TELESTRAIN_INLINE double OffsetOfRow(int row, int side_px) {
  const double half = side_px / 2;
  return (row - half) / half;
}

TELESTRAIN_INLINE double Mean(const SubsetView& subset) {
  double sum = 0;
  for (int row = 0; row < subset.side_px; ++row) {
    const float* gray = RowOf(subset.gray, subset, row);
    Float8 sums{};
    for (int i = 0; i < subset.side_px; i += kLanes) {
      Float8 value = Load(gray + i);
      KeepFirstLanes(subset.side_px - i, value);
      sums += value;
    }
    sum += SumLanes(sums);
  }
  return sum / (static_cast<double>(subset.side_px) * subset.side_px);
}

// Adds one row's sums of v gx, v gx x, v gy, v gy x to the moments against J.
TELESTRAIN_INLINE void AddGradientSums(const Float8 (&row)[4], double y,
                                       std::array<double, 6>& out) {
  const double gx = SumLanes(row[0]), gy = SumLanes(row[2]);
  out[0] += gx;
  out[1] += gy;
  out[2] += SumLanes(row[1]);
  out[3] += gx * y;
  out[4] += SumLanes(row[3]);
  out[5] += gy * y;
}

TELESTRAIN_INLINE ReferenceMoments ReferenceBody(const SubsetView& subset) {
  ReferenceMoments out;
  out.mean = Mean(subset);
  const float mean = static_cast<float>(out.mean);
  for (int row = 0; row < subset.side_px; ++row) {
    Float8 ff{}, j[4]{}, fj[4]{};
    for (int i = 0; i < subset.side_px; i += kLanes) {
      Float8 f = Load(RowOf(subset.gray, subset, row) + i) - mean;
      Float8 gx = Load(RowOf(subset.gradient_x, subset, row) + i);
      Float8 gy = Load(RowOf(subset.gradient_y, subset, row) + i);
      KeepFirstLanes(subset.side_px - i, f);
      KeepFirstLanes(subset.side_px - i, gx);
      KeepFirstLanes(subset.side_px - i, gy);
      const Float8 x = OffsetsFrom(i, subset.side_px);
      const Float8 gxx = gx * x, gyx = gy * x;
      ff += f * f;
      j[0] += gx, j[1] += gxx, j[2] += gy, j[3] += gyx;
      fj[0] += f * gx, fj[1] += f * gxx, fj[2] += f * gy, fj[3] += f * gyx;
    }
    const double y = OffsetOfRow(row, subset.side_px);
    out.ff += SumLanes(ff);
    AddGradientSums(j, y, out.j);
    AddGradientSums(fj, y, out.fj);
  }
  return out;
}

// Adds one row's sums of a product times (1, x, x^2).
TELESTRAIN_INLINE void AddProductSums(const Float8 (&row)[3], double y, ProductMoments& out) {
  const double one = SumLanes(row[0]), x = SumLanes(row[1]);
  out[0] += one;
  out[1] += x;
  out[2] += one * y;
  out[3] += SumLanes(row[2]);
  out[4] += x * y;
  out[5] += one * y * y;
}

TELESTRAIN_INLINE GradientMoments GradientBody(const SubsetView& subset) {
  GradientMoments out;
  for (int row = 0; row < subset.side_px; ++row) {
    Float8 xx[3]{}, xy[3]{}, yy[3]{};
    for (int i = 0; i < subset.side_px; i += kLanes) {
      Float8 gx = Load(RowOf(subset.gradient_x, subset, row) + i);
      Float8 gy = Load(RowOf(subset.gradient_y, subset, row) + i);
      KeepFirstLanes(subset.side_px - i, gx);
      KeepFirstLanes(subset.side_px - i, gy);
      const Float8 x = OffsetsFrom(i, subset.side_px);
      const Float8 gxx = gx * x, gyx = gy * x;
      xx[0] += gx * gx, xx[1] += gx * gxx, xx[2] += gxx * gxx;
      xy[0] += gx * gy, xy[1] += gx * gyx, xy[2] += gxx * gyx;
      yy[0] += gy * gy, yy[1] += gy * gyx, yy[2] += gyx * gyx;
    }
    const double y = OffsetOfRow(row, subset.side_px);
    AddProductSums(xx, y, out.xx);
    AddProductSums(xy, y, out.xy);
    AddProductSums(yy, y, out.yy);
  }
  return out;
}

// All lanes between the same rows and one pixel apart: eight neighbouring coefficients serve as
// one load.
TELESTRAIN_INLINE void InterpolateAligned(const float* first, int stride, const Float8& fraction_x,
                                          const Float8& fraction_y, Float8& value) {
  Float8 weight[6];
  QuinticWeights(fraction_y, weight);
  Float8 along[6];
  const float* row = first;
  for (int k = 0; k < 6; ++k) along[k] = Load(row + k) * weight[0];
  for (int j = 1; j < 6; ++j) {
    row += stride;
    for (int k = 0; k < 6; ++k) along[k] += Load(row + k) * weight[j];
  }
  QuinticWeights(fraction_x, weight);
  value = along[0] * weight[0];
  for (int k = 1; k < 6; ++k) value += along[k] * weight[k];
}

// Each lane its own six by six coefficients. The same operations in the same order as above.
TELESTRAIN_INLINE void InterpolateScattered(const float* first, int stride, const Float8& shift_x,
                                            const Float8& shift_y, Float8& value) {
  constexpr float kAbove = 16;  // makes every shift positive, so that truncation rounds down
  const Int8 whole_x = __builtin_convertvector(shift_x + kAbove, Int8) - static_cast<int>(kAbove);
  const Int8 whole_y = __builtin_convertvector(shift_y + kAbove, Int8) - static_cast<int>(kAbove);
  Float8 weight_x[6], weight_y[6];
  QuinticWeights<Float8>(shift_x - __builtin_convertvector(whole_x, Float8), weight_x);
  QuinticWeights<Float8>(shift_y - __builtin_convertvector(whole_y, Float8), weight_y);
  Float8 along[kLanes];
  for (int lane = 0; lane < kLanes; ++lane) {
    const float* from =
        first + static_cast<std::ptrdiff_t>(whole_y[lane]) * stride + lane + whole_x[lane];
    along[lane] = Load(from) * weight_y[0][lane];
    for (int j = 1; j < 6; ++j) along[lane] += Load(from + j * stride) * weight_y[j][lane];
  }
  Transpose(along);
  value = along[0] * weight_x[0];
  for (int k = 1; k < 6; ++k) value += along[k] * weight_x[k];
}

// The positions of a warped row: (x, y) + column * (1 + du_dx, dv_dx), counted from the
// coefficient `first`, the third one left of and above the whole part of the row's start.
class WarpedRow {
 public:
  TELESTRAIN_INLINE WarpedRow(const SplineView& spline, const SubsetWarp& warp, int row, int side)
      : spline_(spline),
        x_px_(warp.top_left_x_px + row * warp.du_dy),
        y_px_(warp.top_left_y_px + row * (1 + warp.dv_dy)),
        du_dx_(warp.du_dx),
        dv_dx_(warp.dv_dx) {
    // Positions are positive inside the padding: truncation rounds down.
    const int x = static_cast<int>(x_px_), y = static_cast<int>(y_px_);
    start_x_ = static_cast<float>(x_px_ - x);
    start_y_ = static_cast<float>(y_px_ - y);
    first_ = CoefficientsAt(x, y);
    const float end = static_cast<float>((side + kLanes - 1) / kLanes * kLanes - 1);
    in_one_cell_ = InCell(start_x_ + end * static_cast<float>(du_dx_)) &&
                   InCell(start_y_ + end * static_cast<float>(dv_dx_));
  }

  // Grey levels of the pixels from `column` on; `columns` are their numbers.
  TELESTRAIN_INLINE void Interpolate(int column, const Float8& columns, Float8& value) const {
    const float du_dx = static_cast<float>(du_dx_), dv_dx = static_cast<float>(dv_dx_);
    if (in_one_cell_)
      InterpolateAligned(first_ + column, spline_.stride, start_x_ + columns * du_dx,
                         start_y_ + columns * dv_dx, value);
    else
      InterpolateAnywhere(column, value);
  }

 private:
  TELESTRAIN_INLINE static bool InCell(float shift) { return shift >= 0 && shift < 1; }

  TELESTRAIN_INLINE const float* CoefficientsAt(int x, int y) const {
    return spline_.coefficients + static_cast<std::ptrdiff_t>(y - 2) * spline_.stride + (x - 2);
  }

  TELESTRAIN_INLINE void InterpolateAnywhere(int column, Float8& value) const {
    const double x_px = x_px_ + column * (1 + du_dx_), y_px = y_px_ + column * dv_dx_;
    const int x = static_cast<int>(x_px), y = static_cast<int>(y_px);
    const Float8 shift_x =
        static_cast<float>(x_px - x) + LaneNumbers() * static_cast<float>(du_dx_);
    const Float8 shift_y =
        static_cast<float>(y_px - y) + LaneNumbers() * static_cast<float>(dv_dx_);
    if (InCell(shift_x[kLanes - 1]) && InCell(shift_y[kLanes - 1]))
      InterpolateAligned(CoefficientsAt(x, y), spline_.stride, shift_x, shift_y, value);
    else
      InterpolateScattered(CoefficientsAt(x, y), spline_.stride, shift_x, shift_y, value);
  }

  const SplineView& spline_;
  double x_px_, y_px_, du_dx_, dv_dx_;
  float start_x_, start_y_;
  const float* first_;
  bool in_one_cell_;
};

struct RowSums {
  Float8 t{}, tt{}, tf{}, tj[4]{};
};

TELESTRAIN_INLINE void AddWarpedRow(const SubsetView& subset, float mean, const WarpedRow& warped,
                                    int row, RowSums& sums) {
  const float* gray = RowOf(subset.gray, subset, row);
  const float* gradient_x = RowOf(subset.gradient_x, subset, row);
  const float* gradient_y = RowOf(subset.gradient_y, subset, row);
  Float8 columns = LaneNumbers();
  for (int i = 0; i < subset.side_px; i += kLanes, columns += kLanes) {
    Float8 t;
    warped.Interpolate(i, columns, t);
    t -= mean;
    if (subset.side_px - i < kLanes) KeepFirstLanes(subset.side_px - i, t);
    const Float8 x = OffsetsFrom(i, subset.side_px);
    const Float8 tgx = t * Load(gradient_x + i), tgy = t * Load(gradient_y + i);
    sums.t += t;
    sums.tt += t * t;
    sums.tf += t * (Load(gray + i) - mean);
    sums.tj[0] += tgx, sums.tj[1] += tgx * x, sums.tj[2] += tgy, sums.tj[3] += tgy * x;
  }
}

TELESTRAIN_INLINE WarpedMoments WarpedBody(const SubsetView& subset, float mean,
                                           const SplineView& spline, const SubsetWarp& warp) {
  WarpedMoments out;
  for (int row = 0; row < subset.side_px; ++row) {
    RowSums sums;
    AddWarpedRow(subset, mean, WarpedRow(spline, warp, row, subset.side_px), row, sums);
    out.t += SumLanes(sums.t);
    out.tt += SumLanes(sums.tt);
    out.tf += SumLanes(sums.tf);
    AddGradientSums(sums.tj, OffsetOfRow(row, subset.side_px), out.tj);
  }
  return out;
}

// The same source compiled for AVX2 beside the compiler's baseline. Multiplications and additions
// stay separate in both (no fused ones), so that both give the same bits.
#if defined(__x86_64__)
#define TELESTRAIN_AVX2 [[gnu::target("avx2")]]
const bool kHasAvx2 = __builtin_cpu_supports("avx2");
#else
#define TELESTRAIN_AVX2
constexpr bool kHasAvx2 = false;
#endif

TELESTRAIN_AVX2 ReferenceMoments ReferenceAvx2(const SubsetView& subset) {
  return ReferenceBody(subset);
}
TELESTRAIN_AVX2 GradientMoments GradientAvx2(const SubsetView& subset) {
  return GradientBody(subset);
}
TELESTRAIN_AVX2 WarpedMoments WarpedAvx2(const SubsetView& subset, float mean,
                                         const SplineView& spline, const SubsetWarp& warp) {
  return WarpedBody(subset, mean, spline, warp);
}

}  // namespace

ReferenceMoments MeasureReference(const SubsetView& subset) {
  return kHasAvx2 ? ReferenceAvx2(subset) : ReferenceBody(subset);
}

GradientMoments MeasureGradients(const SubsetView& subset) {
  return kHasAvx2 ? GradientAvx2(subset) : GradientBody(subset);
}

WarpedMoments MeasureWarped(const SubsetView& subset, float mean, const SplineView& spline,
                            const SubsetWarp& warp) {
  return kHasAvx2 ? WarpedAvx2(subset, mean, spline, warp) : WarpedBody(subset, mean, spline, warp);
}

}  // namespace telestrain::correlation
