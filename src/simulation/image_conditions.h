#pragma once

#include "simulation/virtual_instrument.h"

namespace telestrain {

// The instrument as it is while image `number` (0, 1, ... in the order calibration, ruler, pipe) is
// taken: vibrating along a direction of that image, and still warming up. Image `number` is taken
// t = preheat + number * interval after switching on. Every view's image is then shifted by
// warmup_drift_um exp(-t / warmup_time), on the object side, along a direction of the view's own,
// and the magnification is off by warmup_drift_ppm exp(-t / warmup_time).
VirtualInstrument InstrumentAtImage(const VirtualExperimentOptions& options,
                                    const VirtualInstrument& warm, int number);

}  // namespace telestrain
