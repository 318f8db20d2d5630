#include "optics/mirror_plate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace telestrain {
namespace {

// Plates that only touch must not count as cutting each other.
constexpr double kShrink = 1e-6;
constexpr double kTouching_mm = 1e-9;
constexpr double kParallelSine = 1e-9;

MirrorPlate Shrunk(MirrorPlate plate) {
  if (plate.outline_mm.empty()) return plate;
  const Eigen::Vector2d middle = MiddleOf(plate.outline_mm);
  for (Eigen::Vector2d& corner : plate.outline_mm) corner += kShrink * (middle - corner);
  return plate;
}

double Height_mm(const MirrorPlate& plate, const Eigen::Vector3d& point_mm) {
  return plate.Normal().dot(point_mm - plate.origin_mm);
}

bool Pierces(const MirrorPlate& plate, const Eigen::Vector3d& from_mm,
             const Eigen::Vector3d& to_mm) {
  const double from = Height_mm(plate, from_mm), to = Height_mm(plate, to_mm);
  if (from * to > 0 || from == to) return false;
  return Contains(plate.outline_mm,
                  plate.InPlate(from_mm + from / (from - to) * (to_mm - from_mm)));
}

// Between two segments (C. Ericson, Real-Time Collision Detection, 5.1.9).
double SegmentDistance_mm(const Eigen::Vector3d& p1, const Eigen::Vector3d& q1,
                          const Eigen::Vector3d& p2, const Eigen::Vector3d& q2) {
  const Eigen::Vector3d d1 = q1 - p1, d2 = q2 - p2, r = p1 - p2;
  const double a = d1.squaredNorm(), e = d2.squaredNorm(), f = d2.dot(r);
  const double b = d1.dot(d2), c = d1.dot(r), denominator = a * e - b * b;
  double s = denominator > 0 ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0.0;
  double t = (b * s + f) / e;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = std::clamp((b * t - c) / a, 0.0, 1.0);
  }
  return (p1 + s * d1 - p2 - t * d2).norm();
}

// From the corners and edges of `a` to the face of `b`; 0 when an edge goes through.
double FaceDistance_mm(const MirrorPlate& a, const MirrorPlate& b) {
  double nearest = std::numeric_limits<double>::max();
  const auto corners = a.Corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (Pierces(b, corners[i], corners[(i + 1) % corners.size()])) return 0;
    if (Contains(b.outline_mm, b.InPlate(corners[i])))
      nearest = std::min(nearest, std::abs(Height_mm(b, corners[i])));
  }
  return nearest;
}

double EdgeDistance_mm(const MirrorPlate& a, const MirrorPlate& b) {
  double nearest = std::numeric_limits<double>::max();
  const auto of_a = a.Corners(), of_b = b.Corners();
  for (std::size_t i = 0; i < of_a.size(); ++i)
    for (std::size_t j = 0; j < of_b.size(); ++j)
      nearest = std::min(nearest, SegmentDistance_mm(of_a[i], of_a[(i + 1) % of_a.size()], of_b[j],
                                                     of_b[(j + 1) % of_b.size()]));
  return nearest;
}

// Keeps the part on the same side of a plane through `on_plane_mm` as `middle_mm`.
void KeepSide(MirrorPlate& plate, const Eigen::Vector3d& on_plane_mm, const Eigen::Vector3d& across,
              const Eigen::Vector3d& middle_mm) {
  const double side = across.dot(middle_mm - on_plane_mm) < 0 ? -1 : 1;
  const Eigen::Vector2d inward(side * across.dot(plate.axis_x), side * across.dot(plate.axis_y));
  if (inward.norm() < kParallelSine) return;
  // The foot of the plane on the plate, along its own steepest direction.
  const double offset = side * across.dot(on_plane_mm - plate.origin_mm);
  plate.outline_mm =
      CutAt(plate.outline_mm, offset / inward.squaredNorm() * inward, inward.normalized());
}

}  // namespace

Eigen::Vector3d MirrorPlate::Normal() const { return axis_x.cross(axis_y); }

std::vector<Eigen::Vector3d> MirrorPlate::Corners() const {
  std::vector<Eigen::Vector3d> corners;
  for (const Eigen::Vector2d& corner : outline_mm) corners.push_back(InArray(corner));
  return corners;
}

Eigen::Vector2d MirrorPlate::Size_mm() const {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : outline_mm) box.extend(corner);
  return outline_mm.empty() ? Eigen::Vector2d::Zero() : Eigen::Vector2d(box.sizes());
}

double GapBetween_mm(const MirrorPlate& a, const MirrorPlate& b) {
  const MirrorPlate first = Shrunk(a), second = Shrunk(b);
  const double faces = std::min(FaceDistance_mm(first, second), FaceDistance_mm(second, first));
  const double gap = faces > 0 ? std::min(faces, EdgeDistance_mm(first, second)) : 0;
  return gap < kTouching_mm ? 0 : gap;
}

bool StandsBetween(const MirrorPlate& plate, const Eigen::Vector3d& from_mm,
                   const Eigen::Vector3d& to_mm) {
  constexpr double kEnd = 1e-9;
  const Eigen::Vector3d way = to_mm - from_mm;
  return Pierces(Shrunk(plate), from_mm + kEnd * way, to_mm - kEnd * way);
}

void PartPlates(MirrorPlate& a, MirrorPlate& b, const Eigen::Vector3d& middle_a_mm,
                const Eigen::Vector3d& middle_b_mm) {
  if (a.Normal().cross(b.Normal()).norm() > kParallelSine) {
    // Each plate ends where the other's plane cuts it.
    const Eigen::Vector3d normal_a = a.Normal(), normal_b = b.Normal();
    KeepSide(a, b.origin_mm, normal_b, middle_a_mm);
    KeepSide(b, a.origin_mm, normal_a, middle_b_mm);
    return;
  }
  const Eigen::Vector3d across = (middle_b_mm - middle_a_mm).normalized();
  const Eigen::Vector3d half_way = 0.5 * (middle_a_mm + middle_b_mm);
  KeepSide(a, half_way, across, middle_a_mm);
  KeepSide(b, half_way, across, middle_b_mm);
}

}  // namespace telestrain
