#include <algorithm>
#include <map>

#include "app/results_folder.h"
#include "app/step_options.h"
#include "app/step_record.h"
#include "app/steps.h"
#include "base/files.h"
#include "viz/picture_set.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

// The pictures that report.pdf shows, as they lie in the results folder.
std::map<std::string, std::string> ReportedPictures(const fs::path& results) {
  std::map<std::string, std::string> bytes;
  for (const viz::PictureKind& kind : viz::PictureKinds()) {
    if (!kind.in_report) continue;
    const std::string name = std::string(kind.name) + ".png";
    if (auto png = ReadFile(results / "pictures" / name, kMostImageBytes))
      bytes[name] = *std::move(png);
  }
  return bytes;
}

StepRecord RenderRecord(const fs::path& results, const RenderOptions& options,
                        const fs::path& out) {
  StepRecord record = SceneRecord("render", results);
  record.options = OptionsJson(options);
  record.options["out"] = RecordedPlace(results, out);
  return record;
}

// Every picture of the standard set that lies there.
std::vector<std::string> PicturesIn(const fs::path& results) {
  std::vector<std::string> names;
  std::error_code code;
  for (fs::directory_iterator entry(results / "pictures", code), end; !code && entry != end;
       entry.increment(code))
    if (const std::string name = entry->path().filename().string(); viz::IsStandardPicture(name))
      names.push_back("pictures/" + name);
  return names;
}

}  // namespace

Status RenderStep(const fs::path& results, Console& console, Earlier earlier) {
  RenderOptions options;
  options.only_reported = true;
  if (earlier == Earlier::kKept) {
    StepRecord record = RenderRecord(results, options, {});
    record.outputs = PicturesIn(results);
    TELESTRAIN_ASSIGN_OR_RETURN(const bool kept, IsKept(results, record, console));
    if (kept) return {};
  }
  return RenderStep(results, options, {}, console);
}

Status RenderStep(const fs::path& results, const RenderOptions& options, const fs::path& out,
                  Console& console) {
  TELESTRAIN_RETURN_IF_ERROR(RequireConsistent(results, Step::kRender));
  // What cannot be drawn must be known before anything in the results folder is touched.
  TELESTRAIN_RETURN_IF_ERROR(CheckRender(results, options));
  const auto before = ReportedPictures(results);
  const bool is_file = !options.view.empty() && out.extension() == ".png";
  const fs::path folder = is_file ? out.parent_path() : out.empty() ? results / "pictures" : out;
  const WrittenFiles written(folder.empty() ? "." : folder);
  const Status rendered = RenderResults(results, options, console, out);
  // A report stays as long as the pictures in it are the ones beside it; those that it lacks may
  // come.
  const auto after = ReportedPictures(results);
  if (!std::includes(after.begin(), after.end(), before.begin(), before.end()))
    TELESTRAIN_RETURN_IF_ERROR(RemoveOutputsFrom(results, Step::kReport));
  TELESTRAIN_RETURN_IF_ERROR(rendered);
  console.Say("render     pictures in " + (out.empty() ? results / "pictures" : out).string());
  StepRecord record = RenderRecord(results, options, out);
  record.outputs = is_file ? std::vector{out.filename().string()} : written.Names();
  record.outputs_folder = folder.empty() ? "." : folder;
  return RecordStep(results, record);
}

}  // namespace telestrain
