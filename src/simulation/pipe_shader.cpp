#include "simulation/pipe_shader.h"

#include <algorithm>
#include <cmath>

#include "simulation/normal_share.h"
#include "simulation/scene_image.h"

namespace telestrain {
namespace {

constexpr double kPaint_gray = 45, kBare_gray = 205, kBackground_gray = 22;
// Diffuse light from the instrument's side: what a surface that turns away still gets.
constexpr double kAmbient = 0.35;
// Blur on a surface that turns away grows at most by the inverse of this.
constexpr double kSmallestCosine = 0.1;
constexpr double kInvisible = 1e-6;

constexpr int kNodeStep_px = 4;
constexpr double kNodeError_mm = 2e-7;

// The arc R asin(x / R) has a fourth derivative below 15 / (R^3 cos^7); a cubic through nodes h
// apart is off by 3 / 128 h^4 of it at the most.
double SmoothCosine(double radius_mm, double node_distance_mm) {
  const double worst_mm = 15 * 3.0 / 128 * std::pow(node_distance_mm, 4) / std::pow(radius_mm, 3);
  return std::max(1.2 * kSmallestCosine, std::pow(worst_mm / kNodeError_mm, 1.0 / 7));
}

}  // namespace

PipeShader::PipeShader(const VirtualInstrument& instrument, const InstrumentView& view,
                       const SpecklePattern& pattern, const DeformedPipe& pipe)
    : instrument_(instrument),
      view_(view),
      blur_(instrument.BlurOf(view)),
      pattern_(pattern),
      pipe_(pipe),
      rays_(pipe),
      smooth_cosine_(
          SmoothCosine(pipe.radius_mm, kNodeStep_px / instrument.lens.magnification_px_per_mm)) {}

// Blur in surface coordinates: the inverse of the 2x2 map to the image plane, taken apart along
// and across the image of the axis, so that what is foreshortened can be held off zero.
Eigen::Matrix2d PipeShader::CovOnSurface_mm2(const Eigen::Matrix<double, 2, 3>& q_from_section,
                                             const Eigen::Vector2d& around,
                                             const Eigen::Matrix2d& cov_q_mm2) const {
  const double length = q_from_section.col(0).norm();
  const Eigen::Vector2d along = q_from_section.col(0) / length;
  const Eigen::Vector2d across(-along.y(), along.x());
  const double seen = across.dot(around);
  Eigen::Matrix2d surface_from_q;
  surface_from_q.row(1) =
      across.transpose() / std::copysign(std::max(std::abs(seen), kSmallestCosine), seen);
  surface_from_q.row(0) = (along.transpose() - along.dot(around) * surface_from_q.row(1)) / length;
  return surface_from_q * cov_q_mm2 * surface_from_q.transpose();
}

PipeShader::Sample PipeShader::SampleAt(const Eigen::Vector2d& ideal_mm,
                                        const SurfaceHit& neighbour) const {
  Sample sample;
  sample.hit = rays_.Hit(instrument_.RayOf(view_, ideal_mm), neighbour);
  const SurfaceHit& hit = sample.hit;
  const Eigen::Vector3d straight_mm = hit.material_mm + hit.displacement_mm;
  const Eigen::Vector3d point_mm =
      pipe_.array_from_pipe * pipe_.Bend(straight_mm) + pipe_.origin_in_array_mm;
  const Eigen::Matrix3d array_from_section =
      pipe_.array_from_pipe * pipe_.BendRotation(straight_mm.x());
  const Eigen::Matrix<double, 2, 3> q_from_section = view_.view.axes_in_array * array_from_section;
  const Eigen::Matrix2d cov_q_mm2 = blur_.CovAt_mm2(view_.BeyondFocus_mm(point_mm));
  const Eigen::Vector2d along = q_from_section.col(0).normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  sample.visible = NormalShare(-hit.miss_mm / std::sqrt(across.dot(cov_q_mm2 * across)));
  if (sample.visible < kInvisible) return sample;

  // Directions around and out of the surface; what the loads turn them by (below 1 mrad, torsion
  // below 20) is nothing to light and blur.
  const double sine = hit.material_mm.y() / pipe_.radius_mm;
  const double cosine = hit.material_mm.z() / pipe_.radius_mm;
  const Eigen::Vector2d around = q_from_section * Eigen::Vector3d(0, cosine, -sine);
  const Eigen::Matrix2d cov_mm2 = CovOnSurface_mm2(q_from_section, around, cov_q_mm2);
  const double upward = array_from_section.row(2).dot(Eigen::Vector3d(0, sine, cosine));
  sample.surface << hit.material_mm.x(), pipe_.radius_mm * std::atan2(sine, cosine), cov_mm2(0, 0),
      cov_mm2(0, 1), cov_mm2(1, 1), kAmbient + (1 - kAmbient) * std::max(0.0, upward);
  sample.is_smooth = sample.visible == 1 && hit.cos_incidence > smooth_cosine_ && upward > 0;
  return sample;
}

float PipeShader::Gray(const Surface& surface, double visible) const {
  if (visible < kInvisible) return static_cast<float>(kBackground_gray);
  Eigen::Matrix2d cov_mm2;
  cov_mm2 << surface[2], surface[3], surface[3], surface[4];
  const double paint = pattern_.Paint(surface.head<2>(), cov_mm2);
  const double gray = (kBare_gray + (kPaint_gray - kBare_gray) * paint) * surface[5];
  return static_cast<float>(kBackground_gray + (gray - kBackground_gray) * visible);
}

void PipeShader::ShadeRow(const std::vector<Eigen::Vector2d>& ideal_mm,
                          std::span<float> gray) const {
  const int count = static_cast<int>(gray.size());
  std::vector<Sample> nodes;
  for (int x = 0; x < count; x += kNodeStep_px)
    nodes.push_back(SampleAt(ideal_mm[x], nodes.empty() ? SurfaceHit() : nodes.back().hit));
  const auto smooth_around = [&nodes](int k) {
    if (k < 1 || k + 2 >= static_cast<int>(nodes.size())) return false;
    return nodes[k - 1].is_smooth && nodes[k].is_smooth && nodes[k + 1].is_smooth &&
           nodes[k + 2].is_smooth;
  };
  Eigen::Vector4d weights[kNodeStep_px];
  for (int i = 0; i < kNodeStep_px; ++i)
    weights[i] = CubicWeights(static_cast<double>(i) / kNodeStep_px);
  for (int x = 0; x < count; ++x) {
    const int k = x / kNodeStep_px;
    const Eigen::Vector4d& w = weights[x % kNodeStep_px];
    if (x % kNodeStep_px == 0) {
      gray[x] = Gray(nodes[k].surface, nodes[k].visible);
    } else if (smooth_around(k)) {
      gray[x] = Gray(w[0] * nodes[k - 1].surface + w[1] * nodes[k].surface +
                         w[2] * nodes[k + 1].surface + w[3] * nodes[k + 2].surface,
                     1);
    } else {
      const Sample sample = SampleAt(ideal_mm[x], nodes[k].hit);
      gray[x] = Gray(sample.surface, sample.visible);
    }
  }
}

}  // namespace telestrain
