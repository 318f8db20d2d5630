#include <algorithm>

#include "app/results_folder.h"
#include "app/steps.h"
#include "viz/picture_set.h"

namespace telestrain {

namespace fs = std::filesystem;

Status RenderStep(const fs::path& results, Console& console) {
  RenderOptions options;
  options.only_reported = true;
  return RenderStep(results, options, {}, console);
}

Status RenderStep(const fs::path& results, const RenderOptions& options, const fs::path& out,
                  Console& console) {
  TELESTRAIN_RETURN_IF_ERROR(RequireConsistent(results, Step::kRender));
  // What cannot be drawn must be known before anything in the results folder is touched.
  TELESTRAIN_RETURN_IF_ERROR(CheckRender(results, options));
  const auto kinds = viz::PictureKinds();
  const bool is_reported =
      options.view.empty() ||
      std::any_of(kinds.begin(), kinds.end(), [&](const viz::PictureKind& kind) {
        return kind.in_report && options.view == kind.name;
      });
  if (out.empty() && is_reported)
    TELESTRAIN_RETURN_IF_ERROR(
        RemoveOutputsFrom(results, options.view.empty() ? Step::kRender : Step::kReport));
  TELESTRAIN_RETURN_IF_ERROR(RenderResults(results, options, console, out));
  console.Say("render     pictures in " + (out.empty() ? results / "pictures" : out).string());
  return {};
}

}  // namespace telestrain
