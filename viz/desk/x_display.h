#pragma once

#include <memory>

#include "base/result.h"

namespace telestrain::viz {

// A connection to the X server that DISPLAY names, which must be able to show OpenGL: VTK ends the
// process where it cannot. The window gets this very connection: an X server whose last client
// leaves may start anew and refuse the next one meanwhile. Fails (kOutputFailed) naming DISPLAY,
// what is wrong and what to do without a screen.
Result<std::shared_ptr<void>> OpenDisplay();

}  // namespace telestrain::viz
