#include "viz/picture_set.h"

#include <algorithm>
#include <array>

#include "base/numbers.h"
#include "viz/rays_picture.h"
#include "viz/scene/scene_colors.h"

namespace telestrain::viz {
namespace {

// A picture that shows the same whatever the choices.
template <auto Draw>
Result<Picture> Always(const Scene& scene, const RenderOptions& options, const PictureChoices&) {
  return Draw(scene, options);
}

bool HasViews(const Scene&) { return true; }  // without a calibration there is no scene
bool HasPipe(const Scene& scene) { return scene.pipe && !scene.pipe->states.empty(); }
bool HasOptics(const Scene& scene) { return scene.optics.has_value(); }
bool HasResiduals(const Scene& scene) { return !scene.residual_cells.empty(); }

constexpr const char* kNoMirrors =
    "the session gives no mirrors; add [camera] and the mirrors of every [[view]] to session.toml "
    "and run 'telestrain calibrate' again";
constexpr const char* kNoStrain = "no strain was measured; run 'telestrain measure' first";
constexpr const char* kNoResiduals = "there is no residuals.csv; run 'telestrain calibrate' again";

constexpr std::array kKinds{
    PictureKind{"array", Always<DrawArray>, HasViews, true, false, ""},
    PictureKind{"side", Always<DrawSide>, HasViews, false, false, ""},
    PictureKind{"top", Always<DrawTop>, HasViews, false, false, ""},
    PictureKind{"rays", Always<DrawOptics>, HasOptics, false, false, kNoMirrors},
    PictureKind{"targets", Always<DrawTargets>, HasViews, true, false, ""},
    PictureKind{"pipe", Always<DrawPipe>, HasPipe, false, false, kNoStrain},
    PictureKind{"pipe_strain", DrawPipeStrain, HasPipe, true, true, kNoStrain},
    PictureKind{"residuals", Always<DrawResiduals>, HasResiduals, false, false, kNoResiduals},
    PictureKind{"contact_sheet", nullptr, HasViews, false, false, ""},
};

Error Usage(std::string message) { return {ErrorKind::kUsage, std::move(message)}; }

std::string Joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

// "--state 'x' does not exist; the nearest is 'y' of: …".
Error Unknown(const std::string& what, const std::string& word,
              const std::vector<std::string>& words) {
  return Usage("pictures: there is no " + what + " '" + word + "'; the nearest is '" +
               NearestWord(word, words) + "' of: " + Joined(words));
}

// "_000": as in pipe_000.vtp.
std::string StateSuffix(std::size_t state) {
  const std::string digits = std::to_string(state);
  return "_" + std::string(digits.size() < 3 ? 3 - digits.size() : 0, '0') + digits;
}

Result<std::size_t> StateFor(const Pipe& pipe, const std::string& word) {
  if (word == "largest") return pipe.largest_state;
  std::vector<std::string> words{"largest"};
  for (std::size_t i = 0; i < pipe.states.size(); ++i) {
    if (word == std::to_string(i) || word == pipe.states[i].image) return i;
    words.push_back(std::to_string(i));
    words.push_back(pipe.states[i].image);
  }
  return Unknown("state", word, words);
}

// The range of all states, so that their pictures compare.
std::array<double, 2> CommonRange(const Pipe& pipe, const std::string& quantity) {
  const ColorScale scale = ValueScale(pipe, quantity);
  return {scale.low, scale.high};
}

// The planned files of one kind.
void AddPlanned(const PictureKind& kind, const Scene& scene, const PictureChoices& choices,
                bool only_reported, std::vector<PlannedPicture>& planned) {
  PictureChoices each = choices;
  if (kind.of_every_state) each.state = scene.pipe->largest_state;
  planned.push_back({std::string(kind.name) + ".png", kind.draw, each});
  if (!kind.of_every_state || only_reported) return;
  each.range = CommonRange(*scene.pipe, choices.quantity);
  for (std::size_t i = 0; i < scene.pipe->states.size(); ++i) {
    each.state = i;
    planned.push_back({kind.name + StateSuffix(i) + ".png", kind.draw, each});
  }
}

bool HasChoices(const RenderOptions& options) {
  return options.state != "largest" || !options.quantity.empty() || options.range;
}

std::string DefaultQuantity(const Pipe& pipe) {
  return pipe.states.front().surface.values.front().quantity.key;
}

// What a file name says of a choice that the standard set does not show.
std::string ChoiceSuffix(const Pipe& pipe, const PictureChoices& choices) {
  std::string suffix;
  if (choices.quantity != DefaultQuantity(pipe)) suffix += "_" + choices.quantity;
  if (choices.range)
    suffix +=
        "_" + FormatShortest((*choices.range)[0]) + "_to_" + FormatShortest((*choices.range)[1]);
  for (char& c : suffix)
    if (c == '/' || c == '\0') c = '_';
  return suffix;
}

// The picture of options.view, which has something to show.
Result<PlannedPicture> PlanView(const PictureKind& kind, const Scene& scene,
                                const RenderOptions& options) {
  if (!kind.of_every_state) return PlannedPicture{kind.name + std::string(".png"), kind.draw, {}};
  TELESTRAIN_ASSIGN_OR_RETURN(PictureChoices choices, ChoicesFor(scene, options));
  const bool is_one_of_many = options.state != "largest";
  const std::string name = kind.name + (is_one_of_many ? StateSuffix(*choices.state) : "") +
                           ChoiceSuffix(*scene.pipe, choices) + ".png";
  if (is_one_of_many && !choices.range) choices.range = CommonRange(*scene.pipe, choices.quantity);
  return PlannedPicture{name, kind.draw, choices};
}

}  // namespace

std::span<const PictureKind> PictureKinds() { return kKinds; }

std::vector<std::string> ViewNames() {
  std::vector<std::string> names;
  for (const PictureKind& kind : kKinds)
    if (kind.draw != nullptr) names.emplace_back(kind.name);
  return names;
}

std::string ViewsWithChoices() {
  std::vector<std::string> names;
  for (const PictureKind& kind : kKinds)
    if (kind.of_every_state) names.emplace_back(kind.name);
  return Joined(names);
}

bool IsStandardPicture(const std::string& file_name) {
  if (!file_name.ends_with(".png")) return false;
  const std::string stem = file_name.substr(0, file_name.size() - 4);
  return std::any_of(kKinds.begin(), kKinds.end(), [&](const PictureKind& kind) {
    if (stem == kind.name) return true;
    if (!kind.of_every_state || !stem.starts_with(std::string(kind.name) + "_")) return false;
    const std::string state = stem.substr(std::string(kind.name).size() + 1);
    return state.size() >= 3 && state.find_first_not_of("0123456789") == std::string::npos;
  });
}

Result<PictureChoices> ChoicesFor(const Scene& scene, const RenderOptions& options) {
  PictureChoices choices;
  if (!HasPipe(scene)) {
    if (!HasChoices(options)) return choices;
    return Usage(std::string("pictures: a state, quantity or range is of the pipe, and ") +
                 kNoStrain);
  }
  const Pipe& pipe = *scene.pipe;
  TELESTRAIN_ASSIGN_OR_RETURN(choices.state, StateFor(pipe, options.state));
  choices.range = options.range;
  std::vector<std::string> keys;
  for (const PointValues& values : pipe.states.front().surface.values)
    keys.push_back(values.quantity.key);
  choices.quantity = options.quantity.empty() ? keys.front() : options.quantity;
  for (std::size_t i = 0; i < pipe.states.size(); ++i) {
    if (pipe.states[i].surface.Find(choices.quantity) != nullptr) continue;
    if (i == 0) return Unknown("quantity", choices.quantity, keys);
    return Usage("pictures: state " + std::to_string(i) + " ('" + pipe.states[i].image +
                 "') has no quantity '" + choices.quantity +
                 "', which state 0 has; run 'telestrain measure' again");
  }
  return choices;
}

Result<std::vector<PlannedPicture>> PlanPictures(const Scene& scene, const RenderOptions& options) {
  std::vector<PlannedPicture> planned;
  if (options.view.empty()) {
    if (HasChoices(options))
      return Usage("pictures: the standard set takes no state, quantity or range; add --view " +
                   ViewsWithChoices());
    TELESTRAIN_ASSIGN_OR_RETURN(const PictureChoices choices, ChoicesFor(scene, options));
    for (const PictureKind& kind : kKinds)
      if (kind.has(scene) && (kind.in_report || !options.only_reported))
        AddPlanned(kind, scene, choices, options.only_reported, planned);
    return planned;
  }
  const auto kind = std::find_if(kKinds.begin(), kKinds.end(), [&](const PictureKind& k) {
    return k.draw != nullptr && options.view == k.name;
  });
  if (kind == kKinds.end()) return Unknown("view", options.view, ViewNames());
  if (!kind->of_every_state && HasChoices(options))
    return Usage("pictures: the view '" + options.view +
                 "' takes no state, quantity or range; these are for: " + ViewsWithChoices());
  if (!kind->has(scene))
    return Usage("pictures: the results have nothing that the view '" + options.view +
                 "' could show: " + kind->remedy);
  TELESTRAIN_ASSIGN_OR_RETURN(PlannedPicture picture, PlanView(*kind, scene, options));
  planned.push_back(std::move(picture));
  return planned;
}

}  // namespace telestrain::viz
