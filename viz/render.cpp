#include "viz/render.h"

#include <string>

#include "base/files.h"
#include "viz/pictures.h"
#include "viz/png_bytes.h"
#include "viz/scene_from_results.h"

namespace telestrain {
namespace {

// Below, the texts do not fit; above, memory passes 4 GB.
constexpr int kLeastWidth_px = 1000, kMostWidth_px = 6000;

Status CheckOptions(const RenderOptions& options) {
  if (options.width_px < kLeastWidth_px || options.width_px > kMostWidth_px)
    return BadInput("pictures: width_px from " + std::to_string(kLeastWidth_px) + " to " +
                    std::to_string(kMostWidth_px) + " is wanted, found " +
                    std::to_string(options.width_px));
  if (options.height_px < options.width_px / 2 || options.height_px > options.width_px)
    return BadInput("pictures: height_px from half the width to the width is wanted, found " +
                    std::to_string(options.height_px) + " for a width of " +
                    std::to_string(options.width_px));
  return {};
}

Status Save(const Result<viz::Picture>& picture, const std::filesystem::path& path,
            Console& console) {
  if (!picture) return picture.error();
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string png, viz::PngBytes(picture->image));
  TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(path, png));
  console.Say("wrote " + path.string());
  return {};
}

Status DrawAll(const viz::Scene& scene, const std::filesystem::path& folder,
               const RenderOptions& options, Console& console) {
  TELESTRAIN_RETURN_IF_ERROR(Save(viz::DrawArray(scene, options), folder / "array.png", console));
  TELESTRAIN_RETURN_IF_ERROR(
      Save(viz::DrawTargets(scene, options), folder / "targets.png", console));
  if (scene.pipe)
    return Save(viz::DrawPipeStrain(scene, options), folder / "pipe_strain.png", console);
  console.Note("no strain.json: pipe_strain.png is not drawn");
  // A picture from an earlier measurement must not stand beside results that have none.
  std::error_code code;
  std::filesystem::remove(folder / "pipe_strain.png", code);
  return {};
}

}  // namespace

Status RenderResults(const std::filesystem::path& results, const RenderOptions& options,
                     Console& console) {
  TELESTRAIN_RETURN_IF_ERROR(CheckOptions(options));
  TELESTRAIN_ASSIGN_OR_RETURN(const viz::Scene scene, viz::SceneFromResults(results));
  const std::filesystem::path folder = results / "pictures";
  TELESTRAIN_RETURN_IF_ERROR(EnsureFolder(folder));
  return DrawAll(scene, folder, options, console);
}

}  // namespace telestrain
