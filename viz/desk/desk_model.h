#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "viz/desk/desk_camera.h"
#include "viz/export/shown_values.h"
#include "viz/scene/part.h"

namespace telestrain::viz {

// A colour bar: what a range of colours stands for.
struct ValueBar {
  std::string title;  // with the unit: "axial strain / µε"
  std::string note;   // what the range covers
  ColorScale scale;
  ColorMap colors;
};

// What the desk program shows, free of any graphics library: a scene's parts and what of them is
// visible, in which state, coloured by which quantity.
class DeskModel {
 public:
  // `title` names the results. Views, pipe, surface, displacements, gauges and frame are visible
  // at first: all layers at once hide each other.
  DeskModel(std::string title, Scene scene, std::optional<ShownValues> shown);

  const std::string& title() const { return title_; }
  const Scene& scene() const { return scene_; }
  const std::vector<Part>& parts() const { return list_.parts; }
  const std::optional<ShownValues>& shown() const { return shown_; }  // empty without a pipe
  const std::vector<Quantity>& quantities() const { return quantities_; }
  double displacement_factor() const { return list_.displacement_factor; }

  // The number of pipe states; 0 when no pipe was measured.
  int States() const;
  void ShowState(int state);  // the nearest that there is
  void StepState(int by);
  void StepQuantity(int by);  // round and round
  // Colours over all states, so that states compare, or over the shown one, so that its pattern is
  // seen.
  void ToggleRange();

  bool Has(Layer layer) const;  // whether any part belongs to it
  bool Shows(Layer layer) const { return visible_.contains(layer); }
  void Toggle(Layer layer);
  void ShowOnly(std::set<Layer> layers) { visible_ = std::move(layers); }
  // The array is looked at with its views, the pipe without what stands in front of it and tints
  // its colours; the other views leave the layers as they are.
  void ArrangeFor(StandardView view);
  bool IsVisible(const Part& part) const;
  // What a standard view makes as large as fits: all visible parts, or the pipe.
  std::vector<Eigen::Vector3d> PointsToFit(StandardView view) const;

  // Of the quantity and of what visible boards and rulers are coloured by.
  std::vector<ValueBar> Bars() const;
  // "state 3 of 0 to 5" and what was measured in it, a line each.
  std::vector<std::string> StateLines() const;

 private:
  std::string title_;
  Scene scene_;
  PartList list_;
  std::optional<ShownValues> shown_;
  std::vector<Quantity> quantities_;
  std::set<Layer> visible_;
  bool own_range_ = false;  // of the shown state

  void Rescale();
};

}  // namespace telestrain::viz
