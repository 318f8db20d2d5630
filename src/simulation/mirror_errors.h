#pragma once

#include "session/session.h"
#include "simulation/random_stream.h"

namespace telestrain {

// The drawing's view behind mirrors that are off: each is tilted by up to `tilt_rad` about either
// of two axes in its plane and shifted by up to `shift_mm` along its normal. Image axes and viewing
// axis are those of ReflectCamera through these mirrors; the view's centre becomes the point that
// the drawing's lens then sees in the middle of the region, in the plane across the viewing axis
// through the drawn one.
NominalView MisalignMirrors(const Session& drawing, const NominalView& view, double tilt_rad,
                            double shift_mm, RandomStream& random);

}  // namespace telestrain
