#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "viz/pictures.h"

namespace telestrain::viz {

// The least size on paper with room for the texts of every picture of the set.
inline constexpr double kLeastPaperWidth_mm = 168, kLeastPaperHeight_mm = 100;

using DrawFunction = Result<Picture> (*)(const Scene&, const RenderOptions&, const PictureChoices&);

// A picture of the standard set.
struct PictureKind {
  const char* name;           // of --view; the file is name.png
  DrawFunction draw;          // null: the contact sheet, made of the others
  bool (*has)(const Scene&);  // whether there is something to draw
  bool in_report;             // report.pdf shows it
  bool of_every_state;  // name_000.png … of every state beside name.png of one; takes choices
  const char* remedy;   // what is missing when has() is false, and what to do
};
// In the order in which they are drawn; the contact sheet is the last.
std::span<const PictureKind> PictureKinds();

// What options.view may name: every kind but the contact sheet, which is made of the whole set.
std::vector<std::string> ViewNames();

// The views that options.state, options.quantity and options.range are for: "pipe_strain".
std::string ViewsWithChoices();

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

// What to draw: the whole set, what the report shows of it, or options.view. Of a kind that has a
// file of every state, the one without a number shows the largest in the range of its own values,
// the others show theirs in the range of all states together. A view of another quantity or of a
// chosen range has a name of its own that is not of the standard set: pipe_strain_001_zncc.png,
// pipe_strain_0_to_500.png. Fails (kUsage) as ChoicesFor does, when there is no such view, when the
// results have nothing for it, and when state, quantity or range are asked for without a view that
// takes them.
Result<std::vector<PlannedPicture>> PlanPictures(const Scene& scene, const RenderOptions& options);

}  // namespace telestrain::viz
