#include "viz/export/scene_files.h"

#include "viz/export/glb.h"
#include "viz/export/paraview.h"
#include "viz/export/ply.h"
#include "viz/export/stl.h"

namespace telestrain::viz {

Result<std::vector<std::pair<std::string, std::string>>> SceneFiles(const Scene& scene,
                                                                    const SceneExport& choice) {
  TELESTRAIN_ASSIGN_OR_RETURN(const auto shown, ChooseValues(scene, choice.state, choice.quantity));
  const bool surface =
      choice.formats.contains(SceneFormat::kStl) || choice.formats.contains(SceneFormat::kPly);
  if (surface && !shown)
    return BadInput(
        "the results hold no measured pipe, which stl and ply are made of; run 'telestrain "
        "measure' first");
  std::vector<std::pair<std::string, std::string>> files;
  const auto parts = PartsOf(scene).parts;
  if (choice.formats.contains(SceneFormat::kGlb))
    files.emplace_back("scene.glb", GlbBytes(parts, AxesOf(scene), shown));
  if (choice.formats.contains(SceneFormat::kStl))
    files.emplace_back("pipe.stl", StlBytes(*scene.pipe, shown->state));
  if (choice.formats.contains(SceneFormat::kPly))
    files.emplace_back("pipe.ply", PlyBytes(*scene.pipe, shown->state));
  if (!choice.formats.contains(SceneFormat::kParaView)) return files;
  TELESTRAIN_ASSIGN_OR_RETURN(auto paraview, ParaViewFiles(scene, parts));
  for (auto& file : paraview) files.push_back(std::move(file));
  return files;
}

}  // namespace telestrain::viz
