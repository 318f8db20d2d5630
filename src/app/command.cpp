#include "app/command.h"

#include <CLI/CLI.hpp>

#include "base/value_names.h"

namespace telestrain {

void SessionArguments::AddTo(CLI::App& app) {
  app.add_option("SESSION", session, "session folder with session.toml, tables and images")
      ->type_name(kFolder)
      ->required();
  app.add_option("--out", out, "results folder; made when it does not exist")
      ->type_name(kFolder)
      ->required();
}

void AddCornersOption(CLI::App& app, std::string& corners) {
  app.add_option(
         "--corners", corners,
         "corners.vnl (mrcal's format, from any detector) to use instead of the calibration "
         "images")
      ->type_name(kFile);
}

void CalibrateArguments::AddTo(CLI::App& app) {
  app.add_option("--compare", compare,
                 "an earlier calibration.json of this instrument: says what moved since, in um on "
                 "the object and in microstrain")
      ->type_name(kFile);
  app.add_option("--outliers", outliers,
                 "what becomes of corners that do not fit: removed beyond 5 sigma by the median "
                 "(median), by mrcal's rule with the sample's sigma (mrcal), or weighed down by "
                 "Cauchy's loss (weigh)")
      ->check(CLI::IsMember({"median", "mrcal", "weigh"}))
      ->capture_default_str();
  app.add_flag("--board-warp", board_warp,
               "estimate how the boards bow (as mrcal does), whether a test asks for it or not");
  app.add_option("--cull", culled,
                 "leave out the corners in X,Y,WIDTH,HEIGHT (px on the sensor); may be repeated")
      ->type_name("X,Y,WIDTH,HEIGHT");
}

void MeasureArguments::AddTo(CLI::App& app) {
  app.add_option("--subset-px", subset_px,
                 "odd side of the square subsets that are correlated (default: a sixteenth of the "
                 "shortest side of a view)")
      ->type_name(kPixels);
  app.add_option("--step-px", step_px,
                 "distance between the subsets (default: their side); a smaller one gives a denser "
                 "map of points that are not independent")
      ->type_name(kPixels);
}

void MeasureArguments::AddWatchTo(CLI::App& app) {
  auto* folder = app.add_option("--watch", watch,
                                "measure the images that arrive in this folder, until interrupted; "
                                "pipe.csv there or in the session names their load steps")
                     ->type_name(kFolder);
  app.add_option("--until", until, "end after so many states")->type_name(kCount)->needs(folder);
  app.add_option("--idle-s", idle_s, "end after so many seconds without a new image")
      ->type_name(kSeconds)
      ->needs(folder);
}

}  // namespace telestrain
