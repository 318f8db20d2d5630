#include "app/render_arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "base/numbers.h"
#include "base/value_names.h"
#include "viz/picture_set.h"

namespace telestrain {
namespace {

// The text with the views that the option is for.
std::string OfViews(const std::string& text, const std::string& more = "") {
  return text + " (view " + viz::ViewsWithChoices() + more + ")";
}

// "2008x1240".
Status ReadSize(const std::string& text, RenderOptions& options) {
  const auto x = text.find('x');
  const auto width = x == std::string::npos ? std::nullopt : ParseInt(text.substr(0, x));
  const auto height = x == std::string::npos ? std::nullopt : ParseInt(text.substr(x + 1));
  if (!width || !height)
    return Error{ErrorKind::kUsage,
                 "--size takes WIDTHxHEIGHT in px, as in 2008x1240, found '" + text + "'"};
  options.width_px = *width;
  options.height_px = *height;
  return {};
}

}  // namespace

void RenderArguments::AddTo(CLI::App& app) {
  auto* one = app.add_option("--view", view, "draw one picture of the standard set (default: all)")
                  ->type_name(Among(viz::ViewNames()));
  app.add_flag("--reported", reported, "only the pictures of the set that report.pdf shows")
      ->excludes(one);
  app.add_option("--state", state,
                 OfViews("state of the pipe: its number from 0, its image or 'largest'"))
      ->type_name("STATE")
      ->capture_default_str();
  app.add_option("--quantity", quantity,
                 OfViews("what colours the pipe: a point array of pipe_NNN.vtp, by default the "
                         "axial strain",
                         "; --states"))
      ->type_name("QUANTITY");
  app.add_option("--range", range,
                 OfViews("ends of the pipe's colour bar, in the quantity's unit", "; --states"))
      ->expected(2)
      ->type_name("LOW HIGH");
  app.add_option("--size", size, "WIDTHxHEIGHT in px, up to 16384 a side (default: 2008x1240)")
      ->type_name("WIDTHxHEIGHT");
  app.add_option("--dpi", dpi,
                 "px per inch on paper, where texts and lines keep their size (default: the "
                 "picture is 170 mm wide)")
      ->type_name(kCount);
  app.add_flag("--transparent", transparent, "nothing instead of white paper");
  app.add_option("--backend", backend, "source of OpenGL; both give the same pictures")
      ->check(CLI::IsMember({"osmesa", "egl"}))
      ->capture_default_str();
  app.add_option("--out", out, "folder, or a file in .png for one view (default: RESULTS/pictures)")
      ->type_name(kPath);
  AddFilmsTo(app);
}

void RenderArguments::AddFilmsTo(CLI::App& app) {
  auto* turn = app.add_option("--turntable", turntable,
                              "make a film in .mp4 or .gif of the array turning once")
                   ->type_name(kFile);
  auto* cycle = app.add_option("--states", states,
                               "make a film in .mp4 or .gif of the strain in every state, in one "
                               "range of colours")
                    ->type_name(kFile);
  turn->excludes(cycle);
  for (auto* film : {turn, cycle})
    for (const char* other : {"--view", "--out", "--transparent", "--state", "--reported"})
      film->excludes(app.get_option(other));
  for (const char* other : {"--quantity", "--range"}) turn->excludes(app.get_option(other));
  app.add_option("--seconds", video.seconds, "length of the film (default: 8; 1.5 per state)")
      ->type_name(kSeconds);
  app.add_option("--fps", video.frames_per_second,
                 "frames per second of the film (default: 20; 10 in .gif)")
      ->type_name(kCount);
}

Result<RenderOptions> ReadOptions(const RenderArguments& arguments) {
  RenderOptions options;
  if (arguments.Film().empty()) {
    if (arguments.video.seconds != 0 || arguments.video.frames_per_second != 0)
      return Error{ErrorKind::kUsage,
                   "--seconds and --fps are of a film; add --turntable or --states"};
  } else {
    TELESTRAIN_ASSIGN_OR_RETURN(options, DefaultFrame(arguments.Film()));
  }
  if (!arguments.size.empty())
    TELESTRAIN_RETURN_IF_ERROR(ReadSize(arguments.size, options));
  else if (arguments.dpi > 0) {  // the same paper
    // Whatever is refused later must fit into an int before.
    const double scale = std::min(1e3, static_cast<double>(arguments.dpi) / options.Dpi());
    options.width_px = static_cast<int>(std::lround(options.width_px * scale));
    options.height_px = static_cast<int>(std::lround(options.height_px * scale));
  }
  options.dots_per_inch = arguments.dpi;
  options.transparent = arguments.transparent;
  options.backend = arguments.backend == "egl" ? GlBackend::kEgl : GlBackend::kOsMesa;
  options.view = arguments.view;
  options.only_reported = arguments.reported;
  options.state = arguments.state;
  options.quantity = arguments.quantity;
  if (arguments.range.size() == 2) options.range = {arguments.range[0], arguments.range[1]};
  TELESTRAIN_RETURN_IF_ERROR(CheckRenderOptions(options));
  return options;
}

}  // namespace telestrain
