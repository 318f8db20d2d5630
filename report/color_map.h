#pragma once

#include <string>

#include "report/page_flow.h"
#include "report/plot_scale.h"

namespace telestrain {

// viridis (van der Walt and Smith, matplotlib): its lightness rises steadily from 0 to 1, so that
// it reads the same in grey and for colour-blind readers. `share` is clamped to [0, 1].
Color MapColor(double share);

// The colours of a range, widened to whole steps of some five ticks.
class ColorScale {
 public:
  explicit ColorScale(const PlotAxis& axis);
  const std::string& label() const { return label_; }
  const PlotScale& scale() const { return scale_; }
  Color ColorOfValue(double value) const { return MapColor(scale_.Share(value)); }

 private:
  std::string label_;
  PlotScale scale_;
};

// An upright bar at the left of `box`, with ticks and label to its right.
inline constexpr double kColorBarWidth_pt = 46;  // bar, ticks and label together
void DrawColorBar(PageFlow& flow, const PageBox& box, const ColorScale& colors);

}  // namespace telestrain
