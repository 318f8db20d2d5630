#pragma once

#include "viz/canvas.h"
#include "viz/scene/scene.h"

namespace telestrain::viz {

// The foot of the pictures of the whole array: axes, what the signs mean, the residuals' colours.

double ArrayKeyHeight(const Canvas& canvas);
// `direction`: that of the picture, for the axes. Fails when the legend does not fit.
Status AddArrayKey(Canvas* canvas, const Scene& scene, const ViewDirection& direction);

}  // namespace telestrain::viz
