#include <algorithm>
#include <array>
#include <map>

#include "viz/results_parts.h"

namespace telestrain::viz {
namespace {

// What was decided, by image.
std::map<std::string, JsonNode> DecisionsOf(const JsonNode& list) {
  std::map<std::string, JsonNode> decisions;
  for (int i = 0; i < list.Size(); ++i)
    decisions.emplace(list.At(i).At("image").Text(), list.At(i));
  return decisions;
}

std::string VerdictOf(const JsonNode& decision) {
  constexpr std::array kVerdicts{"pass", "doubt", "fail", "undecided"};
  if (!decision.Has("verdict")) return "";  // the session asks for none
  const std::string verdict = decision.At("verdict").Text();
  if (std::find(kVerdicts.begin(), kVerdicts.end(), verdict) == kVerdicts.end())
    decision.At("verdict").Fail("pass, doubt, fail or undecided is wanted");
  return verdict;
}

}  // namespace

void AddRulers(const JsonNode& ruler, Scene* scene) {
  const JsonNode list = ruler.At("images");
  const auto decisions = DecisionsOf(ruler.At("acceptance").At("images"));
  for (int i = 0; i < list.Size(); ++i) {
    const JsonNode node = list.At(i);
    if (node.Has("rejected_because") || !node.Has("ends_in_array_mm")) {
      ++scene->rejected_rulers;
      continue;
    }
    const JsonNode ends = node.At("ends_in_array_mm");
    RulerPosition position;
    position.image = node.At("image").Text();
    position.ends_in_array_mm = {ends.At(0).Vector3(), ends.At(1).Vector3()};
    position.error_um = node.At("error_um").Number();
    const auto decision = decisions.find(position.image);
    if (decision == decisions.end())
      throw BadField("acceptance.images: has nothing about " + position.image);
    position.expanded_uncertainty_um = decision->second.At("expanded_uncertainty_um").Number();
    position.verdict = VerdictOf(decision->second);
    scene->rulers.push_back(position);
  }
}

}  // namespace telestrain::viz
