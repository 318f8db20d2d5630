#pragma once

#include <string>

#include "viz/scene/scene.h"

namespace telestrain::viz {

// The measured surface of one state as binary STL: two triangles a quad, in mm of the array frame,
// single precision, normals away from the pipe's axis. The 80 bytes of header name program, unit
// and state.
std::string StlBytes(const Pipe& pipe, std::size_t state);

}  // namespace telestrain::viz
