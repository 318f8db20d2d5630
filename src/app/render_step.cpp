#include <algorithm>
#include <array>

#include "app/results_folder.h"
#include "app/steps.h"
#include "viz/picture_set.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

// The views that report.pdf shows.
constexpr std::array<const char*, 3> kReported{"array", "targets", "pipe_strain"};

}  // namespace

Status RenderStep(const fs::path& results, Console& console) {
  return RenderStep(results, RenderOptions{}, {}, console);
}

Status RenderStep(const fs::path& results, const RenderOptions& options, const fs::path& out,
                  Console& console) {
  TELESTRAIN_RETURN_IF_ERROR(RequireConsistent(results, Step::kRender));
  // What cannot be drawn must be known before anything in the results folder is touched.
  TELESTRAIN_RETURN_IF_ERROR(CheckRender(results, options));
  const bool is_reported = options.view.empty() || std::find(kReported.begin(), kReported.end(),
                                                             options.view) != kReported.end();
  if (out.empty() && is_reported)
    TELESTRAIN_RETURN_IF_ERROR(
        RemoveOutputsFrom(results, options.view.empty() ? Step::kRender : Step::kReport));
  TELESTRAIN_RETURN_IF_ERROR(RenderResults(results, options, console, out));
  console.Say("render     pictures in " + (out.empty() ? results / "pictures" : out).string());
  return {};
}

}  // namespace telestrain
