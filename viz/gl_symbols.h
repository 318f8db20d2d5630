#pragma once

#include "base/result.h"

namespace telestrain::viz {

// Debian's VTK and GLEW are built for GLX. They run on Mesa's off-screen contexts when two
// conditions hold in the final executable; telestrain::viz's link options and this file's object
// see to both:
//  1. libOSMesa is the first library on the link line, so that every gl* call of VTK binds to it
//     and not to libOpenGL's stubs, which do nothing and report nothing without a GLX context;
//  2. the executable exports glXGetProcAddressARB (defined beside this function), through which
//     GLEW looks up all newer entry points.
// libOSMesa's gl* dispatch through libglapi to whatever context of Mesa is current in the thread,
// so both hold for EGL contexts of the same Mesa as well.
//
// Fails (kOutputFailed) with the violated condition: the alternative is a wrong picture and exit
// code 0.
Status CheckGlSymbols();

}  // namespace telestrain::viz
