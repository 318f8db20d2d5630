#include "viz/desk/desk_model.h"

#include <algorithm>

#include "base/numbers.h"
#include "viz/scene/scene_colors.h"

namespace telestrain::viz {

DeskModel::DeskModel(std::string title, Scene scene, std::optional<ShownValues> shown)
    : title_(std::move(title)),
      scene_(std::move(scene)),
      list_(PartsOf(scene_)),
      shown_(std::move(shown)),
      visible_{Layer::kViews,         Layer::kPipe,   Layer::kSurface,
               Layer::kDisplacements, Layer::kGauges, Layer::kFrame} {
  // The window has a scale bar of its own, which is right however the scene is turned.
  std::erase_if(list_.parts, [](const Part& part) { return part.name == "scale bar"; });
  if (shown_) quantities_ = QuantitiesOf(*scene_.pipe);
}

int DeskModel::States() const { return shown_ ? static_cast<int>(scene_.pipe->states.size()) : 0; }

void DeskModel::ShowState(int state) {
  if (!shown_) return;
  shown_->state = static_cast<std::size_t>(std::clamp(state, 0, States() - 1));
  Rescale();
}

void DeskModel::ToggleRange() {
  own_range_ = !own_range_;
  Rescale();
}

void DeskModel::Rescale() {
  if (!shown_) return;
  const Pipe& pipe = *scene_.pipe;
  const std::string& key = shown_->quantity.key;
  shown_->scale =
      own_range_ ? ValueScale({&pipe.states[shown_->state].surface}, key) : ValueScale(pipe, key);
}

void DeskModel::StepState(int by) {
  if (shown_) ShowState(static_cast<int>(shown_->state) + by);
}

void DeskModel::StepQuantity(int by) {
  if (!shown_) return;
  const auto count = static_cast<int>(quantities_.size());
  int index = 0;
  while (quantities_[static_cast<std::size_t>(index)].key != shown_->quantity.key) ++index;
  index = ((index + by) % count + count) % count;
  shown_->quantity = quantities_[static_cast<std::size_t>(index)];
  Rescale();
}

bool DeskModel::Has(Layer layer) const {
  return std::any_of(list_.parts.begin(), list_.parts.end(),
                     [&](const Part& part) { return part.layer == layer; });
}

void DeskModel::Toggle(Layer layer) {
  if (visible_.erase(layer) == 0) visible_.insert(layer);
}

bool DeskModel::IsVisible(const Part& part) const {
  const bool in_state =
      part.state == kEveryState || (shown_ && part.state == static_cast<int>(shown_->state));
  return in_state && Shows(part.layer);
}

void DeskModel::ArrangeFor(StandardView view) {
  if (view == StandardView::kArray) visible_.insert(Layer::kViews);
  if (view != StandardView::kPipe) return;
  for (const Layer layer :
       {Layer::kViews, Layer::kOptics, Layer::kBoards, Layer::kRulers, Layer::kUncertainty})
    visible_.erase(layer);
}

std::vector<Eigen::Vector3d> DeskModel::PointsToFit(StandardView view) const {
  std::vector<Eigen::Vector3d> points;
  for (const Part& part : list_.parts) {
    const bool of_pipe = part.layer == Layer::kPipe || part.layer == Layer::kSurface;
    if (IsVisible(part) && (of_pipe || view != StandardView::kPipe))
      points.insert(points.end(), part.mesh.points_in_array_mm.begin(),
                    part.mesh.points_in_array_mm.end());
  }
  return points.empty() ? PointsOf(list_.parts) : points;
}

std::vector<ValueBar> DeskModel::Bars() const {
  std::vector<ValueBar> bars;
  if (shown_ && Shows(Layer::kSurface))
    bars.push_back({TitleOf(shown_->quantity),
                    std::string(own_range_ ? "range of this state" : "range of all states") +
                        (shown_->scale.clipped ? ", ends open" : ""),
                    shown_->scale, ValueColorMap(shown_->scale)});
  if (Has(Layer::kBoards) && Shows(Layer::kBoards))
    bars.push_back({"board residual RMS / px", "", ResidualScale(scene_.boards),
                    ResidualColors(scene_.boards)});
  if (Has(Layer::kRulers) && Shows(Layer::kRulers))
    bars.push_back({"ruler length error / \u00b5m", "", RulerScale(scene_.rulers),
                    RulerColors(scene_.rulers)});
  return bars;
}

std::vector<std::string> DeskModel::StateLines() const {
  if (!shown_) return {"no pipe was measured"};
  const PipeState& state = scene_.pipe->states[shown_->state];
  const std::string unit = " \u00b5\u03b5";
  const double expanded = scene_.coverage_factor * state.standard_uncertainty_microstrain;
  const bool known = expanded > 0;
  std::vector<std::string> lines{
      "state " + std::to_string(shown_->state) +
          (States() > 1 ? " of 0 to " + std::to_string(States() - 1) : ""),
      "cycle " + state.cycle + ", step " + state.step,
      "long base: " + NumberText(state.axial_microstrain, 1) +
          (known ? " \u00b1 " + FormatFixed(expanded, 1) : "") + unit +
          (known ? " (k = " + FormatShortest(scene_.coverage_factor) + ")" : "")};
  if (state.gauge_mean_microstrain)
    lines.push_back("gauges, mean: " + NumberText(*state.gauge_mean_microstrain, 1) + unit);
  return lines;
}

}  // namespace telestrain::viz
