#pragma once

#include <string>
#include <vector>

#include "report/page_flow.h"
#include "report/plot_scale.h"

namespace telestrain {

enum class Marker { kDot, kSquare, kDiamond, kCross, kTriangle, kPlus };

// A marker around `center`, about 2 `size_pt` wide.
void DrawMarkerShape(PdfDocument& pdf, PagePoint center, Marker marker, Color color,
                     double size_pt);

// A rectangular chart with grid, ticks and labels, drawn as vectors into a box of the page.
class Plot {
 public:
  Plot(PageFlow& flow, const PageBox& outer, const PlotAxis& x, const PlotAxis& y,
       const std::string& title = "");

  PagePoint At(double x, double y) const;
  const PageBox& area() const { return area_; }
  double x_low() const { return x_.low(); }
  double x_high() const { return x_.high(); }
  // Where bars begin: at 0, on a logarithmic axis at its low end.
  double Baseline() const { return y_.logarithmic() ? y_.low() : 0; }

  void DrawMarker(double x, double y, Marker marker, Color color, double size_pt = 2.2);
  void DrawErrorBar(double x, double y, double half_height, Color color, double cap_pt = 2.5);
  // A size for markers that stand one unit of x apart, so that they do not cover each other.
  double MarkerSize_pt() const;
  void DrawCurve(const std::vector<double>& x, const std::vector<double>& y, const Stroke& stroke);
  // A dashed limit over the whole width, its text at the right above the line.
  void DrawLimit(double y, const std::string& text);
  void DrawBar(double x_low, double x_high, double y, Color color);

  struct LegendEntry {
    std::string text;
    Marker marker = Marker::kDot;
    Color color;
    bool line = false;
    Dash dash = Dash::kSolid;  // of the line
  };
  // In a row above the chart's area, or two where one is too narrow.
  void DrawLegend(const std::vector<LegendEntry>& entries);

 private:
  void DrawGrid(const PlotAxis& x, const PlotAxis& y);

  PageFlow& flow_;
  PdfDocument& pdf_;
  PageBox outer_, area_;
  PlotScale x_, y_;
};

}  // namespace telestrain
