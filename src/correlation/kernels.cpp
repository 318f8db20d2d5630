#include "correlation/kernels.h"

namespace telestrain::correlation {
namespace {

bool Has(VectorLevel level) {
#if defined(TELESTRAIN_X86)
  if (level == VectorLevel::kAvx512)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("fma");
  if (level == VectorLevel::kAvx2)
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#endif
  return level == VectorLevel::kPlain;
}

Kernels KernelsOf(VectorLevel level) {
#if defined(TELESTRAIN_X86)
  if (level == VectorLevel::kAvx512) return Avx512Kernels();
  if (level == VectorLevel::kAvx2) return Avx2Kernels();
#endif
  static_cast<void>(level);
  return PlainKernels();
}

struct Chosen {
  explicit Chosen(VectorLevel chosen) : level(chosen), kernels(KernelsOf(chosen)) {}
  VectorLevel level;
  Kernels kernels;
};

Chosen& Choice() {
  static Chosen chosen(BestVectorLevel());
  return chosen;
}

const Kernels& Active() { return Choice().kernels; }

}  // namespace

std::string NameOf(VectorLevel level) {
  switch (level) {
    case VectorLevel::kAvx512:
      return "avx512";
    case VectorLevel::kAvx2:
      return "avx2";
    case VectorLevel::kPlain:
      break;
  }
  return "plain";
}

std::optional<VectorLevel> VectorLevelOf(std::string_view name) {
  for (const VectorLevel level : kVectorLevels)
    if (name == NameOf(level)) return level;
  return std::nullopt;
}

VectorLevel BestVectorLevel() {
  for (VectorLevel level : {VectorLevel::kAvx512, VectorLevel::kAvx2})
    if (Has(level)) return level;
  return VectorLevel::kPlain;
}

bool SetVectorLevel(VectorLevel level) {
  if (!Has(level)) return false;
  Choice() = Chosen(level);
  return true;
}

VectorLevel ActiveVectorLevel() { return Choice().level; }

const Kernels& ActiveKernels() { return Active(); }

ReferenceMoments MeasureReference(const SubsetView& subset, int order) {
  return Active().reference[order][subset.mask != nullptr](subset);
}

WarpedMoments MeasureWarpedBand(const SubsetView& subset, float mean, const SplineView& spline,
                                const SubsetWarp& warp, int order, int band) {
  return Active().warped[spline.degree == 5][order][subset.mask != nullptr](subset, mean, spline,
                                                                            warp, band);
}

WarpedMoments operator+(const WarpedMoments& a, const WarpedMoments& b) {
  WarpedMoments sum{a.t + b.t, a.tt + b.tt, a.tf + b.tf, {}, {}};
  for (int k = 0; k < kLargestBasis; ++k) {
    sum.tjx[k] = a.tjx[k] + b.tjx[k];
    sum.tjy[k] = a.tjy[k] + b.tjy[k];
  }
  return sum;
}

}  // namespace telestrain::correlation
