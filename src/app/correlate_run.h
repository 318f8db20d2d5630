#pragma once

#include "app/correlate_arguments.h"
#include "base/console.h"

namespace telestrain {

// Checks the arguments and every input, assesses the pattern, follows the points through the images
// and writes all results; one image is held at a time beside the reference. Nothing is written
// before the inputs are found good. Fails as the functions of correlate_setup.h, and with
// kEstimationFailed after all results are written when an image has not one converged point.
Status RunCorrelation(const CorrelateArguments& arguments, Console& console);

}  // namespace telestrain
