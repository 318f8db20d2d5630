#pragma once

#include <memory>

#include "base/result.h"
#include "viz/gl_context.h"

namespace telestrain::viz {

// A context of libOSMesa, current in this thread. Fails (kOutputFailed) when there is none.
Result<std::unique_ptr<GlContext>> MakeOsMesaContext();

}  // namespace telestrain::viz
