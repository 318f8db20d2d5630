#include <array>
#include <charconv>
#include <cmath>
#include <string>

#include "diagnostics/pattern_catalogue.h"

namespace telestrain {
namespace {

// Three digits, whatever the locale.
std::string Digits(double value) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 3);
  return {text, end.ptr};
}

// What is wrong and what to do about it, for the lens that all views share and for one view alone.
struct Words {
  const char* name;
  const char* remedy;
  const char* remedy_of_one_view;
};

constexpr const char* kOwnLens =
    "Give every view a lens of its own in the model, and look for a bent or stressed mirror in "
    "this view's path.";

// In the order of PatternKind.
constexpr std::array<Words, 15> kWords{{
    {"radial distortion k1", "Free k1 in the lens model.", kOwnLens},
    {"radial distortion k2", "Free k2 in the lens model.", kOwnLens},
    {"tangential distortion p1 p2", "Free p1 and p2 in the lens model.", kOwnLens},
    {"unequal scales along u and v", "Free the aspect in the lens model.", kOwnLens},
    {"a scale that changes with depth", "Free the telecentricity in the lens model.", kOwnLens},
    {"a magnification of its own", "", kOwnLens},
    {"a board that is not flat",
     "State its flatness in session.toml (flatness_um), so that its bow is adjusted, or have it "
     "measured.",
     ""},
    {"a board whose squares differ from the certificate",
     "Check the certified pitch of this board, and that it is not stretched or sheared.", ""},
    {"a board that lies elsewhere on the plate than certified",
     "Check the certified distance, height and tilt of the boards, and that none came loose.", ""},
    {"a drift over the images", "",
     "Let the instrument warm up, fasten this view's mirrors and record the target again."},
    {"a constant offset", "",
     "The calibration is not the optimum of these corners: calibrate with them again."},
    {"a mislabelled board", "Number this board's corners anew or leave it out.", ""},
    {"a board that does not fit the others",
     "Look at this board's image (cover, blur, glare) and leave it out.", ""},
    {"boards that do not fit one pose of the target",
     "The target or the stage moved during the exposure, or the corners are of different images: "
     "leave this image out.",
     ""},
    {"a pattern of unknown cause",
     "Look at the vector field of the residuals and at their regional means.", ""},
}};

std::string ViewName(const ArrayState& state, int view) {
  const std::string& name = state.array.views[static_cast<std::size_t>(view)].name;
  return name.empty() ? std::to_string(view) : name;
}

std::string WhereOf(const CalibrationData& data, const ArrayState& state, const PatternFinding& f) {
  std::string where;
  const auto add = [&](const std::string& part) { where += (where.empty() ? "" : ", ") + part; };
  if (f.view >= 0) add("view " + ViewName(state, f.view));
  if (f.board >= 0 && f.view < 0)
    add("board " + data.target.boards[static_cast<std::size_t>(f.board)].group);
  if (f.image >= 0) add("image " + data.images[static_cast<std::size_t>(f.image)].image);
  return where;
}

std::string SizeOf(const PatternFinding& f) {
  std::string size = Digits(f.rms_px) + " px RMS";
  for (const PatternParameter& value : f.values)
    if (std::abs(value.value) > 3 * value.sigma)
      size += ", " + value.name + " " + Digits(value.value) + " +- " + Digits(value.sigma);
  if (f.kind == PatternKind::kMislabelled)
    size +=
        ", fits to " + Digits(f.labels.rms_px) + " px when its labels move by " + ToText(f.labels);
  return size;
}

}  // namespace

void Describe(const CalibrationData& data, const ArrayState& state, PatternFinding& f) {
  const Words& words = kWords.at(static_cast<std::size_t>(f.kind));
  const std::string where = WhereOf(data, state, f);
  f.name = words.name + (where.empty() ? "" : " (" + where + ")");
  f.remedy = f.view >= 0 && *words.remedy_of_one_view ? words.remedy_of_one_view : words.remedy;
  f.text = f.name + ": " + SizeOf(f);
  for (std::size_t i = 0; i < f.alternatives.size(); ++i)
    f.text += (i == 0 ? "; hardly to be told from " : ", ") + f.alternatives[i];
  f.text += ".";
}

}  // namespace telestrain
