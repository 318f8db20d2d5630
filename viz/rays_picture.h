#pragma once

#include <filesystem>

#include "optics/rig_design.h"
#include "viz/pictures.h"

namespace telestrain::viz {

// The way of light through a rig (the paper's Fig. 2c): panel "oblique" shows every path from the
// sensor's quarter over its mirrors, at the size that `design` found, to the patch and the pipe;
// panel "along pipe" shows the same from the side, along the array's x. The sensor stands in front
// of the first mirrors at object scale, wherever the camera's reference point is: a telecentric
// path has no length before the mirrors. Fails as the other pictures do.
Result<Picture> DrawRays(const OpticalRig& rig, const RigDesign& design,
                         const RenderOptions& options);

// The same of the rig that the session gives; needs scene.optics. Fails (kBadInput) as AnalyseRig.
Result<Picture> DrawOptics(const Scene& scene, const RenderOptions& options);

// Draws the picture at the default size and writes it as PNG.
Status RenderRays(const OpticalRig& rig, const RigDesign& design,
                  const std::filesystem::path& path);

}  // namespace telestrain::viz
