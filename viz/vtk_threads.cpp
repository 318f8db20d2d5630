#include "viz/vtk_threads.h"

// Compiled as C++17 (CMakeLists.txt): VTK 9.1's header is none of C++20.
#include <vtkSMPTools.h>

namespace telestrain::viz {

void SetVtkThreads(int threads) { vtkSMPTools::Initialize(threads); }

}  // namespace telestrain::viz
