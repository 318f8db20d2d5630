#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "viz/scene/part.h"

namespace telestrain::viz {

// The whole scene for ParaView: `scene.vtm` and the VTK XML PolyData files that it names, as bytes
// by their paths, the index last. A block per layer holds a block per part, named as the part; the
// layer `surface` holds a block per state with points, quads and, as point data named with their
// units like those of pipe_NNN.vtp, displacement_mm (a vector), sigma_um, every quantity and the
// group. Coordinates in mm, array frame. A part's facts are the field data array `facts`, one
// "name: value" each. Same scene, same bytes. Fails (kOutputFailed) when VTK's writer does.
Result<std::vector<std::pair<std::string, std::string>>> ParaViewFiles(
    const Scene& scene, const std::vector<Part>& parts);

// Whether a file below scene/ has a name as ParaViewFiles() gives it: "boards_000.vtp".
bool IsParaViewPiece(const std::string& file_name);

}  // namespace telestrain::viz
