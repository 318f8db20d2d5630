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

constexpr std::array kKinds{
    PictureKind{"array", Always<DrawArray>, HasViews, true, false},
    PictureKind{"side", Always<DrawSide>, HasViews, false, false},
    PictureKind{"top", Always<DrawTop>, HasViews, false, false},
    PictureKind{"rays", Always<DrawOptics>, HasOptics, false, false},
    PictureKind{"targets", Always<DrawTargets>, HasViews, true, false},
    PictureKind{"pipe", Always<DrawPipe>, HasPipe, false, false},
    PictureKind{"pipe_strain", DrawPipeStrain, HasPipe, true, true},
    PictureKind{"residuals", Always<DrawResiduals>, HasResiduals, false, false},
    PictureKind{"contact_sheet", nullptr, HasViews, false, false},
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

// The planned files of one kind.
void AddPlanned(const PictureKind& kind, const Scene& scene, const PictureChoices& choices,
                bool only_reported, std::vector<PlannedPicture>& planned) {
  PictureChoices each = choices;
  if (kind.of_every_state) each.state = scene.pipe->largest_state;
  planned.push_back({std::string(kind.name) + ".png", kind.draw, each});
  if (!kind.of_every_state || only_reported) return;
  if (!each.range) {  // one for all, so that the pictures compare
    const ColorScale scale = ValueScale(*scene.pipe, choices.quantity);
    each.range = {scale.low, scale.high};
  }
  for (std::size_t i = 0; i < scene.pipe->states.size(); ++i) {
    each.state = i;
    planned.push_back({kind.name + StateSuffix(i) + ".png", kind.draw, each});
  }
}

}  // namespace

std::span<const PictureKind> PictureKinds() { return kKinds; }

std::vector<std::string> PictureNames() {
  std::vector<std::string> names;
  for (const PictureKind& kind : kKinds) names.emplace_back(kind.name);
  return names;
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
    if (options.state == "largest" && options.quantity.empty() && !options.range) return choices;
    return Usage(
        "pictures: a state, quantity or range is of the pipe, and no strain was measured; run "
        "'telestrain measure' first");
  }
  const Pipe& pipe = *scene.pipe;
  TELESTRAIN_ASSIGN_OR_RETURN(choices.state, StateFor(pipe, options.state));
  choices.range = options.range;
  std::vector<std::string> keys;
  for (const PointValues& values : pipe.states.front().surface.values)
    keys.push_back(values.quantity.key);
  choices.quantity = options.quantity.empty() ? keys.front() : options.quantity;
  for (const PipeState& state : pipe.states)
    if (state.surface.Find(choices.quantity) == nullptr)
      return Unknown("quantity", options.quantity, keys);
  return choices;
}

Result<std::vector<PlannedPicture>> PlanPictures(const Scene& scene, const RenderOptions& options) {
  TELESTRAIN_ASSIGN_OR_RETURN(const PictureChoices choices, ChoicesFor(scene, options));
  std::vector<PlannedPicture> planned;
  if (options.view.empty()) {
    for (const PictureKind& kind : kKinds)
      if (kind.has(scene) && (kind.in_report || !options.only_reported))
        AddPlanned(kind, scene, choices, options.only_reported, planned);
    return planned;
  }
  const auto kind = std::find_if(kKinds.begin(), kKinds.end(),
                                 [&](const PictureKind& k) { return options.view == k.name; });
  if (kind == kKinds.end() || kind->draw == nullptr) {
    std::vector<std::string> names = PictureNames();
    std::erase(names, "contact_sheet");  // is made of the whole set
    return Unknown("view", options.view, names);
  }
  if (!kind->has(scene))
    return Usage("pictures: the results have nothing that the view '" + options.view +
                 "' could show; run 'telestrain measure' first");
  const bool is_one_of_many = kind->of_every_state && options.state != "largest";
  const std::string suffix = is_one_of_many ? StateSuffix(*choices.state) : "";
  planned.push_back({options.view + suffix + ".png", kind->draw, choices});
  return planned;
}

}  // namespace telestrain::viz
