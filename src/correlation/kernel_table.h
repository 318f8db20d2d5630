#pragma once

#include "correlation/filter_kernel.h"
#include "correlation/kernels.h"
#include "correlation/reference_kernel.h"
#include "correlation/warp_kernel.h"

// All passes of one instruction set. Only for kernels_*.cpp.
namespace telestrain::correlation {
namespace {

template <int kOrder>
void AddOrder(Kernels& kernels) {
  kernels.reference[kOrder][0] = Reference<kOrder, false>;
  kernels.reference[kOrder][1] = Reference<kOrder, true>;
  kernels.warped[0][kOrder][0] = Warped<3, kOrder, false>;
  kernels.warped[0][kOrder][1] = Warped<3, kOrder, true>;
  kernels.warped[1][kOrder][0] = Warped<5, kOrder, false>;
  kernels.warped[1][kOrder][1] = Warped<5, kOrder, true>;
}

Kernels MakeKernels() {
  Kernels kernels;
  AddOrder<0>(kernels);
  AddOrder<1>(kernels);
  AddOrder<2>(kernels);
  kernels.filter = Filter;
  return kernels;
}

}  // namespace
}  // namespace telestrain::correlation
