#include "viz/render.h"

#include <algorithm>
#include <future>
#include <string>

#include "base/files.h"
#include "base/parallel.h"
#include "viz/picture_set.h"
#include "viz/png_bytes.h"
#include "viz/scaled_image.h"
#include "viz/scene_from_results.h"
#include "viz/window_keeper.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

// Draws the pictures one after the other and encodes each while the next is being drawn. What is
// kept of one is its PNG, a few percent of its pixels, and its half for the contact sheet.
class Series {
 public:
  Series(const viz::Scene& scene, const RenderOptions& options)
      : scene_(scene), options_(options) {}

  // The files' bytes in the order of `planned`.
  Result<std::vector<std::string>> Draw(const std::vector<viz::PlannedPicture>& planned) {
    for (std::size_t i = 0; i <= planned.size(); ++i) {
      Status drawn;
      std::optional<RgbImage> next;
      // All drawing stays on this thread: the OpenGL context is current on it.
      auto encoded = std::async(BesideOwnWork(), [&] { return last_ ? Encode() : Status(); });
      if (i < planned.size()) drawn = DrawOne(planned[i], next);
      TELESTRAIN_RETURN_IF_ERROR(encoded.get());
      TELESTRAIN_RETURN_IF_ERROR(drawn);
      last_ = std::move(next);
      if (last_ && planned.size() > 1) sheet_.emplace_back(planned[i].file_name, Half(*last_));
    }
    return std::move(files_);
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

  Status Encode() {
    TELESTRAIN_ASSIGN_OR_RETURN(std::string png, viz::PngBytes(*last_));
    files_.push_back(std::move(png));
    return {};
  }

  const viz::Scene& scene_;
  const RenderOptions& options_;
  std::optional<RgbImage> last_;
  std::vector<std::string> files_;
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
    if (!fs::remove(path, code) && code) return CannotRemove(path, "an old picture", code.value());
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
  const bool is_file = !options.view.empty() && folder.extension() == ".png";
  // What cannot be written is known before the drawing.
  if (!is_file) TELESTRAIN_RETURN_IF_ERROR(EnsureFolder(folder));
  const viz::WindowKeeper keeper;
  TELESTRAIN_ASSIGN_OR_RETURN(const auto files, Series(scene, options).Draw(planned));
  if (options.view.empty()) TELESTRAIN_RETURN_IF_ERROR(RemoveOthers(folder, planned));
  for (std::size_t i = 0; i < files.size(); ++i) {
    const fs::path path = is_file ? folder : folder / planned[i].file_name;
    TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(path, files[i]));
    console.Say("wrote " + path.string());
  }
  if (options.view.empty() && !scene.pipe) console.Note("no strain.json: the pipe is not drawn");
  return {};
}

}  // namespace telestrain
