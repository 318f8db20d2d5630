#pragma once

#include <string>
#include <vector>

#include "viz/desk/desk_model.h"
#include "viz/desk/flat_sheet.h"

namespace telestrain::viz {

// What a click on a part of the panel does.
enum class DeskAction { kToggleLayer, kShowState, kStepQuantity };
struct HotArea {
  PixelBox box;
  DeskAction action = DeskAction::kToggleLayer;
  int argument = 0;  // the layer, the state, or by how many quantities
};

// The key that shows and hides a layer, a lower-case letter.
char KeyOf(Layer layer);

struct PanelContent {
  std::string picked_title;  // the name of what the facts are about; empty: nothing is picked
  std::vector<Fact> facts;
};

// Draws the panel into the box: the state with its slider, the quantity with its colour bar, the
// layers and the facts of what is picked, as many as there is room for. Returns where it can be
// clicked.
std::vector<HotArea> DrawPanel(const DeskModel& model, const PanelContent& content,
                               const PixelBox& box, FlatSheet* sheet);

}  // namespace telestrain::viz
