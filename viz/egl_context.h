#pragma once

#include <memory>

#include "base/result.h"
#include "viz/gl_context.h"

namespace telestrain::viz {

// Whether libEGL is installed. It is opened when it is asked for, never linked.
bool HasEgl();

// A context without a surface on Mesa's software device (EGL_MESA_device_software), even where
// there is a GPU; current in this thread. Fails (kOutputFailed) with what is missing.
Result<std::unique_ptr<GlContext>> MakeEglContext();

}  // namespace telestrain::viz
