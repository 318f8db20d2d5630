#include "viz/render.h"

#include <algorithm>
#include <future>
#include <string>

#include "base/files.h"
#include "viz/picture_set.h"
#include "viz/png_bytes.h"
#include "viz/scaled_image.h"
#include "viz/scene_from_results.h"
#include "viz/window_keeper.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

// Draws the pictures one after the other and writes each while the next is being drawn.
class Series {
 public:
  Series(const viz::Scene& scene, const RenderOptions& options, Console& console)
      : scene_(scene), options_(options), console_(console) {}

  Status Draw(const std::vector<viz::PlannedPicture>& planned, const std::vector<fs::path>& paths) {
    for (std::size_t i = 0; i <= planned.size(); ++i) {
      Status drawn;
      std::optional<RgbImage> next;
      // All drawing stays on this thread: the OpenGL context is current on it.
      auto saved = std::async([&] { return last_ ? Save(paths[i - 1]) : Status(); });
      if (i < planned.size()) drawn = DrawOne(planned[i], next);
      TELESTRAIN_RETURN_IF_ERROR(saved.get());
      TELESTRAIN_RETURN_IF_ERROR(drawn);
      if (last_) console_.Say("wrote " + paths[i - 1].string());
      last_ = std::move(next);
      if (last_ && planned.size() > 1) sheet_.emplace_back(planned[i].file_name, Half(*last_));
    }
    return {};
  }

 private:
  using RgbImage = viz::RgbImage;

  Status DrawOne(const viz::PlannedPicture& planned, std::optional<RgbImage>& image) {
    TELESTRAIN_ASSIGN_OR_RETURN(
        viz::Picture picture,
        planned.draw != nullptr ? planned.draw(scene_, options_, planned.choices) : Sheet());
    image = std::move(picture.image);
    return {};
  }

  Result<viz::Picture> Sheet() const {
    std::vector<viz::NamedImage> named;
    for (const auto& [name, half] : sheet_) named.push_back({name, &half});
    return viz::DrawContactSheet(named, std::to_string(named.size()) + " pictures of the results",
                                 options_);
  }

  // On the sheet none is larger, unless there is but one.
  static RgbImage Half(const RgbImage& image) {
    return viz::Reduced(image, (image.width_px + 1) / 2, (image.height_px + 1) / 2);
  }

  Status Save(const fs::path& path) const {
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string png, viz::PngBytes(*last_));
    return WriteFileAtomically(path, png);
  }

  const viz::Scene& scene_;
  const RenderOptions& options_;
  Console& console_;
  std::optional<RgbImage> last_;
  std::vector<std::pair<std::string, RgbImage>> sheet_;  // file names and halves
};

// A picture from an earlier measurement must not stand beside results that have none.
Status RemoveOthers(const fs::path& folder, const std::vector<viz::PlannedPicture>& planned) {
  std::vector<fs::path> outdated;
  std::error_code code;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end;
       entry.increment(code)) {
    const std::string name = entry->path().filename().string();
    const bool stays =
        !viz::IsStandardPicture(name) ||
        std::any_of(planned.begin(), planned.end(),
                    [&](const viz::PlannedPicture& p) { return p.file_name == name; });
    if (!stays) outdated.push_back(entry->path());
  }
  for (const fs::path& path : outdated)
    if (!fs::remove(path, code) && code)
      return OutputFailed(path.string() + ": an old picture cannot be removed: " + code.message());
  return {};
}

}  // namespace

Status CheckRender(const fs::path& results, const RenderOptions& options) {
  TELESTRAIN_RETURN_IF_ERROR(CheckRenderOptions(options));
  TELESTRAIN_ASSIGN_OR_RETURN(const viz::Scene scene, viz::SceneFromResults(results));
  const auto planned = viz::PlanPictures(scene, options);
  return planned ? Status() : planned.error();
}

Result<bool> PicturesAreComplete(const fs::path& results) {
  TELESTRAIN_ASSIGN_OR_RETURN(const viz::Scene scene, viz::SceneFromResults(results));
  TELESTRAIN_ASSIGN_OR_RETURN(const auto planned, viz::PlanPictures(scene, {}));
  return std::all_of(planned.begin(), planned.end(), [&](const viz::PlannedPicture& picture) {
    std::error_code code;
    return fs::is_regular_file(results / "pictures" / picture.file_name, code);
  });
}

Status RenderResults(const fs::path& results, const RenderOptions& options, Console& console,
                     const fs::path& out) {
  TELESTRAIN_RETURN_IF_ERROR(CheckRenderOptions(options));
  TELESTRAIN_ASSIGN_OR_RETURN(const viz::Scene scene, viz::SceneFromResults(results));
  TELESTRAIN_ASSIGN_OR_RETURN(const auto planned, viz::PlanPictures(scene, options));
  const fs::path folder = out.empty() ? results / "pictures" : out;
  const viz::WindowKeeper keeper;
  if (!options.view.empty() && folder.extension() == ".png")
    return Series(scene, options, console).Draw(planned, {folder});
  TELESTRAIN_RETURN_IF_ERROR(EnsureFolder(folder));
  if (options.view.empty()) TELESTRAIN_RETURN_IF_ERROR(RemoveOthers(folder, planned));
  std::vector<fs::path> paths;
  for (const viz::PlannedPicture& picture : planned) paths.push_back(folder / picture.file_name);
  TELESTRAIN_RETURN_IF_ERROR(Series(scene, options, console).Draw(planned, paths));
  if (options.view.empty() && !scene.pipe) console.Note("no strain.json: the pipe is not drawn");
  return {};
}

}  // namespace telestrain
