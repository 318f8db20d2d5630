#pragma once

#include <string>
#include <vector>

#include "report/page_flow.h"

namespace telestrain {

// One axis: its range is widened to whole steps; ticks stand at round numbers.
struct PlotAxis {
  std::string label;
  double low = 0, high = 1;  // any order is corrected, an empty range is widened
  bool whole_numbers = false;
  bool widen = true;  // to whole steps
};

enum class Marker { kDot, kSquare, kDiamond, kCross };

// A rectangular chart with grid, ticks and labels, drawn as vectors into a box of the page.
class Plot {
 public:
  Plot(PageFlow& flow, const PageBox& outer, const PlotAxis& x, const PlotAxis& y,
       const std::string& title = "");

  PagePoint At(double x, double y) const;
  const PageBox& area() const { return area_; }
  double x_low() const { return x_.low; }
  double x_high() const { return x_.high; }

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
  };
  // In a row above the chart's area.
  void DrawLegend(const std::vector<LegendEntry>& entries);

 private:
  struct Scale {
    double low = 0, high = 1, step = 1;
    int decimals = 0;
    std::vector<double> Ticks() const;
  };
  static Scale MakeScale(const PlotAxis& axis, double length_pt, double spacing_pt);
  void DrawMarkerAt(PagePoint p, Marker marker, Color color, double size_pt);
  void DrawGrid(const PlotAxis& x, const PlotAxis& y);

  PageFlow& flow_;
  PdfDocument& pdf_;
  PageBox outer_, area_;
  Scale x_, y_;
};

}  // namespace telestrain
