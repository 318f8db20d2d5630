#include "target/saddle_window.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "target/blurred_saddle.h"

namespace telestrain {
namespace {

using Eigen::Vector2d;

// Pixels count as near a line so far beyond the profile's reach: the parameters may move by as
// much, and the blur by a tenth, before the pixels must be sorted again.
constexpr double kSlack_px = 0.6;
constexpr double kBlurSlack = 1.1;

// Narrows [low, high] to the x with |offset + slope x| <= 1.
void ClipToUnitBand(double offset, double slope, double* low, double* high) {
  if (std::abs(slope) < 1e-12) {
    if (std::abs(offset) > 1) *high = *low - 1;
    return;
  }
  const double a = (-1 - offset) / slope, b = (1 - offset) / slope;
  *low = std::max(*low, std::min(a, b));
  *high = std::min(*high, std::max(a, b));
}

// The columns of a row where |normal . (x, y)| <= reach, cut to the span; (x, y) from the corner.
struct Columns {
  int begin = 0, end = 0;
};

Columns NearLine(const Vector2d& normal, double dy, double reach, double corner_column,
                 const Columns& span) {
  double low = span.begin, high = span.end - 1;
  low -= corner_column, high -= corner_column;
  ClipToUnitBand(normal.y() * dy / reach, normal.x() / reach, &low, &high);
  if (!(low <= high)) return {span.begin, span.begin};  // may be too far away for an int
  Columns near{static_cast<int>(std::ceil(low + corner_column)),
               static_cast<int>(std::floor(high + corner_column)) + 1};
  if (near.begin >= near.end) near.begin = near.end = span.begin;
  return near;
}

struct GraySums {
  double gray = 0, gray_i = 0, gray_squares = 0;
};

// Over pixels i = 0, 1, ..; in lanes and a fixed order.
TELESTRAIN_WIDE GraySums SumsOf(const float* __restrict pixels, int count) {
  constexpr int kLanes = 4;
  double g[kLanes] = {}, gi[kLanes] = {}, gg[kLanes] = {}, at[kLanes] = {0, 1, 2, 3};
  int i = 0;
  for (; i + kLanes <= count; i += kLanes)
    for (int l = 0; l < kLanes; ++l) {
      const double level = static_cast<double>(pixels[i + l]);
      g[l] += level;
      gi[l] += level * at[l];
      gg[l] += level * level;
      at[l] += kLanes;
    }
  for (; i < count; ++i) {
    const double level = static_cast<double>(pixels[i]);
    g[0] += level;
    gi[0] += level * i;
    gg[0] += level * level;
  }
  const auto total = [](const double(&l)[kLanes]) { return (l[0] + l[1]) + (l[2] + l[3]); };
  return {total(g), total(gi), total(gg)};
}

}  // namespace

// The lines' normals, their derivatives by the angles, and the saddle.
struct SaddleWindow::Lines {
  explicit Lines(const SaddleParameters& p)
      : normal_u(-std::sin(p[8]), std::cos(p[8])),
        normal_v(std::sin(p[9]), -std::cos(p[9])),
        turn_u(-std::cos(p[8]), -std::sin(p[8])),
        turn_v(std::cos(p[9]), std::sin(p[9])),
        inverse_blur(std::exp(-p[10])),
        rho(std::clamp(normal_u.dot(normal_v), -0.99, 0.99)),
        saddle(rho) {}
  Vector2d normal_u, normal_v, turn_u, turn_v;
  double inverse_blur, rho;
  BlurredSaddle saddle;
};

SaddleWindow::SaddleWindow(const GrayImage& image, const PixelRegion& region,
                           const SaddleStart& start)
    : image_(image),
      origin_(start.pixel),
      extent_px_(start.half_axis_u_px.norm() + start.half_axis_v_px.norm()) {
  const Vector2d u = start.half_axis_u_px, v = start.half_axis_v_px;
  const double det = u.x() * v.y() - u.y() * v.x();
  const double half_height = std::abs(u.y()) + std::abs(v.y());
  const int first = std::max(region.y, static_cast<int>(std::ceil(start.pixel.y() - half_height)));
  const int last = std::min(region.y + region.height - 1,
                            static_cast<int>(std::floor(start.pixel.y() + half_height)));
  for (int y = first; y <= last; ++y) {
    const double dy = y - start.pixel.y();
    double low = region.x - start.pixel.x();
    double high = region.x + region.width - 1 - start.pixel.x();
    ClipToUnitBand(-v.x() * dy / det, v.y() / det, &low, &high);
    ClipToUnitBand(u.x() * dy / det, -u.y() / det, &low, &high);
    if (!(low <= high)) continue;
    const int begin = static_cast<int>(std::ceil(low + start.pixel.x()));
    const int end = static_cast<int>(std::floor(high + start.pixel.x())) + 1;
    if (begin < end) rows_.push_back({y, begin, end}), pixels_ += end - begin;
  }
}

void SaddleWindow::Plane::Add(double x, double y, const float* pixels, int count) {
  const GraySums sums = SumsOf(pixels, count);
  const double g = sums.gray, gx = x * g + sums.gray_i, gg = sums.gray_squares;
  const double n = count, last = count - 1;
  const double sum_x = n * x + 0.5 * n * last;
  const double sum_xx = n * x * x + x * n * last + n * last * (2 * n - 1) / 6;
  moments +=
      (Eigen::Matrix3d() << n, sum_x, n * y, sum_x, sum_xx, sum_x * y, n * y, sum_x * y, n * y * y)
          .finished();
  gray += Eigen::Vector3d(g, gx, g * y);
  gray_squares += gg;
}

void SaddleWindow::SortRow(const RowSpan& row, const SaddleParameters& p, const Lines& lines) {
  const double reach = BlurredSaddle::kReach * kBlurSlack / lines.inverse_blur + kSlack_px;
  const double corner_column = origin_.x() + p[6];
  const double y = row.y - origin_.y(), dy = y - p[7];
  const Columns span{row.x_begin, row.x_end};
  const Columns near_u = NearLine(lines.normal_u, dy, reach, corner_column, span);
  const Columns near_v = NearLine(lines.normal_v, dy, reach, corner_column, span);
  std::array<int, 6> cuts{row.x_begin,  near_u.begin, near_u.end,
                          near_v.begin, near_v.end,   row.x_end};
  std::sort(cuts.begin(), cuts.end());
  const float* gray = image_.pixels.data() + static_cast<std::ptrdiff_t>(row.y) * image_.width;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const int begin = cuts[i], count = cuts[i + 1] - begin;
    if (count == 0) continue;
    const bool u = begin >= near_u.begin && begin < near_u.end;
    const bool v = begin >= near_v.begin && begin < near_v.end;
    const double x = begin - origin_.x();
    const Vector2d from_corner(x - p[6], dy);
    const double from_u = lines.normal_u.dot(from_corner), from_v = lines.normal_v.dot(from_corner);
    if (u && v) {
      middle_.pixels().Append(x, y, 1, gray + begin, count);
    } else if (u) {
      strips_[0].pixels().Append(x, y, from_v > 0 ? 1 : -1, gray + begin, count);
    } else if (v) {
      strips_[1].pixels().Append(x, y, from_u > 0 ? 1 : -1, gray + begin, count);
    } else {
      planes_[(from_u > 0) == (from_v > 0) ? 1 : 0].Add(x, y, gray + begin, count);
    }
  }
}

void SaddleWindow::Sort(const SaddleParameters& parameters) {
  sorted_for_ = parameters;
  planes_ = {};
  for (BlockPixels* pixels : {&strips_[0].pixels(), &strips_[1].pixels(), &middle_.pixels()})
    pixels->Clear(), pixels->Reserve(pixels_);
  const Lines lines(parameters);
  for (const RowSpan& row : rows_) SortRow(row, parameters, lines);
  for (BlockPixels* pixels : {&strips_[0].pixels(), &strips_[1].pixels(), &middle_.pixels()})
    pixels->Pad();
}

bool SaddleWindow::Holds(const SaddleParameters& parameters) const {
  const SaddleParameters moved = parameters - sorted_for_;
  const double turn = moved.segment<2>(8).cwiseAbs().maxCoeff();
  return moved.segment<2>(6).norm() + turn * extent_px_ < kSlack_px &&
         moved[10] < std::log(kBlurSlack);
}

void SaddleWindow::StartLinear(SaddleParameters* parameters) const {
  constexpr double kLeastPixels = 20;  // of a plane, for its mean to be a level
  parameters->head<kLinear>().setZero();
  const double low = planes_[0].moments(0, 0), high = planes_[1].moments(0, 0);
  if (std::min(low, high) >= kLeastPixels) {
    const double dark = planes_[0].gray[0] / low, bright = planes_[1].gray[0] / high;
    (*parameters)[0] = 0.5 * (bright + dark);
    (*parameters)[3] = 0.5 * (bright - dark);
    return;
  }
  const SaddleEquations at = At(*parameters);
  parameters->head<kLinear>() =
      at.normal.topLeftCorner<kLinear, kLinear>().ldlt().solve(at.gradient.head<kLinear>());
}

void SaddleWindow::AddPlanes(const SaddleParameters& p, SaddleEquations* sums) const {
  for (const int positive : {0, 1}) {
    const Plane& plane = planes_[static_cast<std::size_t>(positive)];
    const double sign = positive ? 1 : -1;
    const Eigen::Vector3d q = p.segment<3>(0) + sign * p.segment<3>(3);
    const Eigen::Vector3d model = plane.moments * q;
    sums->normal.block<3, 3>(0, 0) += plane.moments;
    sums->normal.block<3, 3>(3, 0) += sign * plane.moments;
    sums->normal.block<3, 3>(3, 3) += plane.moments;
    sums->gradient.segment<3>(0) += plane.gray - model;
    sums->gradient.segment<3>(3) += sign * (plane.gray - model);
    sums->cost += plane.gray_squares - 2 * q.dot(plane.gray) + q.dot(model);
  }
}

void SaddleWindow::AddStrip(int line, const SaddleParameters& p, const Lines& lines,
                            SaddleEquations* sums) const {
  EdgeStrip::Line at;
  at.center_px = p.segment<2>(6);
  at.normal = line == 0 ? lines.normal_u : lines.normal_v;
  at.turned_normal = line == 0 ? lines.turn_u : lines.turn_v;
  at.inverse_blur = lines.inverse_blur;
  const auto strip = strips_[static_cast<std::size_t>(line)].At(at, p.head<kLinear>());
  std::array<int, EdgeStrip::kColumns> place{0, 1, 2, 3, 4, 5, 6, 7, 8 + line, 10};
  for (int i = 0; i < EdgeStrip::kColumns; ++i) {
    const int to = place[static_cast<std::size_t>(i)];
    for (int j = i; j < EdgeStrip::kColumns; ++j)
      sums->normal(place[static_cast<std::size_t>(j)], to) += strip.normal(j, i);
    sums->gradient[to] += strip.gradient[i];
  }
  sums->cost += strip.cost;
}

void SaddleWindow::AddMiddle(const SaddleParameters& p, const Lines& lines,
                             SaddleEquations* sums) const {
  const EdgeCrossing::Lines at{p.segment<2>(6), lines.normal_u, lines.normal_v,
                               lines.turn_u,    lines.turn_v,   lines.inverse_blur};
  const auto middle = middle_.At(at, lines.saddle, p.head<kLinear>());
  sums->normal += middle.normal;
  sums->gradient += middle.gradient;
  sums->cost += middle.cost;
}

SaddleEquations SaddleWindow::At(const SaddleParameters& parameters) const {
  SaddleEquations sums;
  AddPlanes(parameters, &sums);
  const Lines lines(parameters);
  for (const int line : {0, 1}) AddStrip(line, parameters, lines, &sums);
  AddMiddle(parameters, lines, &sums);
  sums.normal.triangularView<Eigen::StrictlyUpper>() = sums.normal.transpose();
  return sums;
}

}  // namespace telestrain
