#pragma once

#include <string>
#include <vector>

#include "report/plot.h"

namespace telestrain {

// How a series looks: told apart by colour, and in grey by marker and dashes.
struct SeriesLook {
  Color color;
  Marker marker = Marker::kDot;
  Dash dash = Dash::kSolid;
};
SeriesLook LookOfSeries(std::size_t index);
// Of the plot's `index`-th limit.
Stroke StrokeOfLimit(const Look& look, std::size_t index);
inline constexpr Color kBarFill = ColorOf(0xC3D5E9);

enum class LegendSample { kLine, kLineWithMarker, kMarker, kBox, kFrame };

struct LegendItem {
  std::string text;
  LegendSample sample = LegendSample::kLine;
  SeriesLook look;
};

// A legend over the whole width of a plot, in as many rows as it needs; long texts wrap.
class PlotLegend {
 public:
  PlotLegend(PageFlow& flow, std::vector<LegendItem> items, double width_pt);
  double height_pt() const;
  void Draw(PagePoint top_left);

 private:
  struct Placed {
    double x_pt = 0;
    int row = 0;
    std::vector<std::string> lines;
  };
  void DrawSample(const LegendItem& item, PagePoint left);

  PageFlow& flow_;
  std::vector<LegendItem> items_;
  std::vector<Placed> placed_;
  int rows_ = 0;
};

}  // namespace telestrain
