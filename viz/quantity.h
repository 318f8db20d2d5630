#pragma once

#include <string>

#include "viz/scene/scene.h"

namespace telestrain::viz {

// Name and unit of the point data `key` of a pipe_NNN.vtp. One that is not known has its key as
// name and the unit of its suffix (_microstrain, _um, _mm, _px, _deg, _rad), none without.
Quantity QuantityOf(const std::string& key);

}  // namespace telestrain::viz
