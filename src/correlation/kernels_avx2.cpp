// The passes for the instruction set AVX2; CMakeLists.txt sets the flags.
#include "correlation/kernel_table.h"

namespace telestrain::correlation {

Kernels Avx2Kernels() { return MakeKernels(); }

}  // namespace telestrain::correlation
