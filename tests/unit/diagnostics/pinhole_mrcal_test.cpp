#include "diagnostics/pinhole_mrcal.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "diagnostics/pinhole_comparison.h"
#include "geometry/rotation.h"
#include "unit/diagnostics/pinhole_array.h"

namespace telestrain {
namespace {

using testing_support::MakeCase;
using testing_support::PinholeCase;
using testing_support::SyntheticOptions;

double Now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

TEST(SpikeP, A) {
  SyntheticOptions so;
  so.poses = 18;
    PinholeCase made = MakeCase(so);
    auto crosses = MakeRulers(made.array, 8);
    double t0=Now(); double c0=double(clock());
    auto found = ComparePinhole(made.array.session, made.data, made.telecentric, crosses);
    std::printf("%.3f s cpu %.3f tele %.5f\n", Now()-t0,(double(clock())-c0)/CLOCKS_PER_SEC, found->telecentric.rms_px);
    for (auto& arm : found->arms)
      std::printf("%s D %g rms %.5f ruler %.3f max %.3f runs %d conv %d starts %d wrong %d\n", arm.model.c_str(), arm.working_distance_mm, arm.reprojection.rms_px, arm.ruler_rmse_um, arm.ruler_max_um, arm.runs, arm.converged, arm.starts, arm.wrong_minima);
    for (double turn : {3.,10.,20.,40.}) for (double D:{100.,1000., 1e5}) {
      PinholeComparisonOptions o; o.distances_mm={D}; o.distorted_distances_mm={}; o.seeded_distance_mm=D; o.seeds=10; o.seed_turn_deg=turn;
    c0=double(clock());
    auto f = ComparePinhole(made.array.session, made.data, made.telecentric, crosses, o);
    std::printf("turn %g D %g wrong %d of %d cpu %.3f\n",turn,D,f->arms[0].wrong_minima,f->arms[0].starts,(double(clock())-c0)/CLOCKS_PER_SEC);
    }
}

}  // namespace
}  // namespace telestrain
