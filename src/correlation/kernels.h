#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "correlation/subset_moments.h"

namespace telestrain::correlation {

// Instruction sets that the passes are compiled for. AVX2 (with FMA) and AVX-512 give the same
// bits; the plain level has no fused operations and differs in the last digits.
enum class VectorLevel { kPlain, kAvx2, kAvx512 };
inline constexpr auto kVectorLevels = {VectorLevel::kPlain, VectorLevel::kAvx2,
                                       VectorLevel::kAvx512};

// plain, avx2, avx512.
std::string NameOf(VectorLevel level);
std::optional<VectorLevel> VectorLevelOf(std::string_view name);

// The best that this machine has.
VectorLevel BestVectorLevel();
// What the passes use: the best one until another is set.
VectorLevel ActiveVectorLevel();
// Makes all passes use the level, for tests and benchmarks, before any other thread works. False
// (and nothing changed) where the machine lacks it.
bool SetVectorLevel(VectorLevel level);

// One separable filter over a strip of columns: rows [first_row, last_row) of the output.
struct FilterStrip {
  const float* image;  // pixel (0, 0); outside, the image is mirrored
  std::ptrdiff_t stride;
  int width, height;
  const float *kernel_x, *kernel_y;  // 2 reach + 1 weights each
  int reach_x, reach_y;
  int first_column, columns;  // at most kStripColumns
  int first_row, last_row;
  float* out;  // where (first_column, first_row) goes
  std::ptrdiff_t out_stride;
};
inline constexpr int kStripColumns = 128;
inline constexpr int kLargestReach = 40;

struct Kernels {
  ReferenceMoments (*reference[3][2])(const SubsetView&);  // by order and whether masked
  // By degree (3, 5), order and whether masked.
  WarpedMoments (*warped[2][3][2])(const SubsetView&, float, const SplineView&, const SubsetWarp&,
                                   int band);
  void (*filter)(const FilterStrip&);
};

const Kernels& ActiveKernels();
Kernels PlainKernels();
Kernels Avx2Kernels();
Kernels Avx512Kernels();

}  // namespace telestrain::correlation
