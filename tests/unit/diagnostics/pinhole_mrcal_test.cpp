#include "diagnostics/pinhole_mrcal.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "geometry/rotation.h"
#include "unit/diagnostics/pinhole_array.h"

namespace telestrain {
namespace {

using testing_support::MakeCase;
using testing_support::PinholeCase;
using testing_support::RmsError_um;
using testing_support::SyntheticOptions;

double Now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

TEST(SpikeP, A) {
  SyntheticOptions so;
  so.poses = 18;
  for (bool mirrored : {false, true}) {
    so.mirrored = mirrored;
    PinholeCase made = MakeCase(so);
    auto crosses = MakeRulers(made.array, 8);
    std::printf("tele rms %.6f\n", made.telecentric_rms_px);
    for (bool distorted : {false, true})
      for (double D : {100., 300., 1000., 3000., 1e4, 1e5}) {
        PinholeOptions o;
        o.working_distance_mm = D;
        o.free_distortion = distorted;
        double t0 = Now();
        auto m = CalibratePinholeWithMrcal(made.array.session, made.data, made.telecentric, o);
        double t1 = Now();
        auto c = CalibratePinhole(made.array.session, made.data, made.telecentric, o);
        double t2 = Now();
        if (!m.ok()) { std::printf("D %g FAIL %s\n", D, m.error().message.c_str()); continue; }
        std::printf("D %g dist %d mrcal rms %.9f (%d runs, lim %d, %.3f s) ruler %.4f um; ceres rms %.9f (%d it, %.3f s) ruler %.4f\n", D,
                    distorted, m->all.rms_px, m->iterations, m->hit_iteration_limit, t1 - t0,
                    RmsError_um(MeasureRulerWithPinhole(made.array.session, m->views, crosses)),
                    c->all.rms_px, c->iterations, t2 - t1,
                    RmsError_um(MeasureRulerWithPinhole(made.array.session, c->views, crosses)));
      }
  }
}

}  // namespace
}  // namespace telestrain
