#include "measurement/pipe_geometry.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "unit/measurement/virtual_pipe.h"

namespace telestrain {
namespace {

using testing_support::Random;
using testing_support::VirtualPipe;

PipeShape BentShape(double radius_of_bend_mm) {
  PipeShape shape;
  shape.origin_in_array_mm = {0, 0, -4};
  shape.radius_mm = 4;
  if (radius_of_bend_mm != 0)
    shape.curvature_per_mm = Eigen::Vector2d(0.6, 0.8) / radius_of_bend_mm;
  return shape;
}

// The grid of VirtualPipe on another shape, its pixels with noise.
PipeGrid GridOn(const VirtualPipe& pipe, const PipeShape& shape, double noise_px,
                std::uint64_t seed) {
  Random random(seed);
  PipeGrid grid = pipe.grid;
  for (PipePoint& point : grid.points) {
    const double angle = (point.row - 4) * 0.12;
    const Eigen::Vector3d wanted =
        shape.InArray({(point.group == 0 ? -13.85 : 13.85) + (point.column - 5.5) * 0.4,
                       4 * std::sin(angle), 4 * std::cos(angle)});
    const int first = 2 * point.group;
    // Slides the point on the surface until the first view sees it at whole pixels.
    point.first_center_px = pipe.array.Project(first, wanted).array().round().cast<int>();
    const ImageRay ray = pipe.array.RayOf(first, point.first_center_px.cast<double>());
    double depth_mm = pipe.array.views[static_cast<std::size_t>(first)].Depth_mm(wanted);
    for (int i = 0; i < 50; ++i) depth_mm += shape.Distance_mm(ray.At(depth_mm));
    point.reference_in_array_mm = ray.At(depth_mm);
    point.second_pixel = pipe.array.Project(first + 1, point.reference_in_array_mm) +
                         Eigen::Vector2d(random.Normal(noise_px), random.Normal(noise_px));
    point.reference_in_array_mm =
        Triangulate(pipe.array,
                    {{first, point.first_center_px.cast<double>(), Eigen::Matrix2d::Zero()},
                     {first + 1, point.second_pixel, Eigen::Matrix2d::Zero()}})
            .in_array_mm;
  }
  return grid;
}

TEST(PipeShape, StraighteningUndoesBending) {
  for (const double bend_mm : {0.0, 80.0, 1e4, 1e9}) {
    const PipeShape shape = BentShape(bend_mm);
    for (const double s : {-14.0, 0.0, 9.0})
      for (const double angle : {-2.0, 0.3, 1.0}) {
        const Eigen::Vector3d straight(s, 4 * std::sin(angle), 4 * std::cos(angle));
        EXPECT_LT((shape.Straighten(shape.InArray(straight)) - straight).norm(), 1e-12);
        const Eigen::Matrix3d axes = shape.SurfaceAxes(straight);
        EXPECT_LT((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm(), 1e-12);
        // The first axis is where a small step along the pipe goes.
        const Eigen::Vector3d step =
            shape.InArray(straight + Eigen::Vector3d(1e-4, 0, 0)) - shape.InArray(straight);
        EXPECT_LT((step.normalized() - axes.col(0)).norm(), 1e-5);
      }
  }
}

TEST(PipeGeometry, ABentPipeIsFoundBentAndAStraightOneStraight) {
  const VirtualPipe pipe;
  constexpr double kNoise_px = 0.02;
  const auto bent = MeasurePipeGeometry(pipe.array, GridOn(pipe, BentShape(2000), kNoise_px, 3), 8);
  ASSERT_TRUE(bent.ok()) << bent.error().message;
  EXPECT_TRUE(bent->is_bent);
  EXPECT_LT(bent->bending_probability, 1e-6);
  EXPECT_NEAR(bent->curvature_per_mm, 1 / 2000.0, 4 * bent->sigma_curvature_per_mm);
  EXPECT_NEAR(bent->deviation_um, 0, 4 * bent->standard_uncertainty_um);
  int called_bent = 0;
  constexpr int kTrials = 50;
  for (int t = 0; t < kTrials; ++t) {
    const auto straight =
        MeasurePipeGeometry(pipe.array, GridOn(pipe, BentShape(0), kNoise_px, 10 + t), 8);
    ASSERT_TRUE(straight.ok()) << straight.error().message;
    called_bent += straight->is_bent;
    EXPECT_NEAR(straight->deviation_um, 0, 4.5 * straight->standard_uncertainty_um);
  }
  EXPECT_LE(called_bent, 2);  // 1e-3 of 50: more than 2 has a probability of 2e-5
}

TEST(PipeGeometry, RoundnessIsTheScatterOfTheSurface) {
  const VirtualPipe pipe;
  const auto geometry = MeasurePipeGeometry(pipe.array, GridOn(pipe, BentShape(0), 0.02, 5), 8);
  ASSERT_TRUE(geometry.ok());
  ASSERT_EQ(geometry->radial_deviation_mm.size(), pipe.grid.points.size());
  double squares = 0;
  for (const double deviation : geometry->radial_deviation_mm) squares += deviation * deviation;
  EXPECT_NEAR(geometry->roundness_rms_um,
              1000 * std::sqrt(squares / static_cast<double>(pipe.grid.points.size())), 1e-9);
  EXPECT_GT(geometry->roundness_peak_to_valley_um, 2 * geometry->roundness_rms_um);
}

}  // namespace
}  // namespace telestrain
