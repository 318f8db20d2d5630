#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "viz/pictures.h"

namespace telestrain::viz {

using DrawFunction = Result<Picture> (*)(const Scene&, const RenderOptions&, const PictureChoices&);

// A picture of the standard set.
struct PictureKind {
  const char* name;           // of --view; the file is name.png
  DrawFunction draw;          // null: the contact sheet, made of the others
  bool (*has)(const Scene&);  // whether there is something to draw
  bool in_report;             // report.pdf shows it
  bool of_every_state;        // name_000.png … of every state beside name.png of one
};
// In the order in which they are drawn; the contact sheet is the last.
std::span<const PictureKind> PictureKinds();

// "array", "targets", …
std::vector<std::string> PictureNames();

// Whether the standard set has a file of this name, for some number of states.
bool IsStandardPicture(const std::string& file_name);

// One file to write.
struct PlannedPicture {
  std::string file_name;
  DrawFunction draw;
  PictureChoices choices;
};

// What options.state, options.quantity and options.range mean for this scene. Fails (kUsage) when
// there is no such state or quantity, with the nearest and all that there are; without a pipe
// nothing may be asked for.
Result<PictureChoices> ChoicesFor(const Scene& scene, const RenderOptions& options);

// What to draw: the whole set, what the report shows of it, or options.view. In the whole set the
// file without a number shows the largest state of a kind that has a file of every state. Fails
// (kUsage) as ChoicesFor does, and when there is no such view or the results have nothing for it.
Result<std::vector<PlannedPicture>> PlanPictures(const Scene& scene, const RenderOptions& options);

}  // namespace telestrain::viz
