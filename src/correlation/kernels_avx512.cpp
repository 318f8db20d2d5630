// The passes for the instruction set AVX-512; CMakeLists.txt sets the flags.
#include "correlation/kernel_table.h"

namespace telestrain::correlation {

Kernels Avx512Kernels() { return MakeKernels(); }

}  // namespace telestrain::correlation
