#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "viz/scene/scene.h"

namespace telestrain::viz {

enum class SceneFormat {
  kGlb,       // scene.glb: the scene in one state for presentations, Blender, the web
  kParaView,  // scene.vtm with its pieces below scene/: everything, all states
  kStl,       // pipe.stl: the measured surface in one state
  kPly        // pipe.ply: its points with all quantities
};

struct SceneExport {
  std::set<SceneFormat> formats;
  std::string state = "largest";  // as ChooseValues takes it; not for ParaView
  std::string quantity;           // that colours scene.glb; empty: the axial strain
};

// Bytes by path below the folder, in the order in which to write them: what names other files
// comes last. Nothing is written. Fails (kUsage) for a state or quantity that does not exist,
// (kBadInput) when the surface is asked for and no pipe was measured.
Result<std::vector<std::pair<std::string, std::string>>> SceneFiles(const Scene& scene,
                                                                    const SceneExport& choice);

}  // namespace telestrain::viz
