// The passes for the compiler baseline; CMakeLists.txt sets the flags.
#include "correlation/kernel_table.h"

namespace telestrain::correlation {

Kernels PlainKernels() { return MakeKernels(); }

}  // namespace telestrain::correlation
