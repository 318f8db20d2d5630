#include "viz/legend.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace telestrain::viz {
namespace {

constexpr Rgb kTitleColor{0.08, 0.19, 0.31};
constexpr Rgb kFactsColor{0.33, 0.38, 0.44};
constexpr double kSign_pt = 12, kGap_pt = 4, kMargin_pt = 6;
constexpr double kColumnGap_pt = 14, kLeastColumnGap_pt = 5;

void AddSign(Canvas* canvas, const LegendEntry& entry, const PixelBox& box) {
  Overlay& shapes = canvas->Shapes();
  switch (entry.sign) {
    case LegendEntry::Sign::kNone:
      break;
    case LegendEntry::Sign::kBox:
      shapes.AddBox(box, entry.color, entry.opacity);
      shapes.AddFrame(box, entry.color, canvas->Px(0.6));
      break;
    case LegendEntry::Sign::kFrame:
      shapes.AddFrame(box, entry.color, canvas->Px(1.0));
      break;
    case LegendEntry::Sign::kColors:
      for (int i = 0; i < ColorMap::kEntries; ++i) {
        const double step = box.width / ColorMap::kEntries;
        const Rgb& color = entry.colors->table()[static_cast<std::size_t>(i)];
        shapes.AddBox({box.left + i * step, box.bottom, step, box.height}, color);
      }
      break;
    case LegendEntry::Sign::kLine: {
      const double middle = box.bottom + 0.5 * box.height;
      shapes.AddLine({box.left, middle}, {box.Right(), middle}, entry.color, canvas->Px(1.5));
      break;
    }
  }
}

}  // namespace

Status AddLegend(Canvas* canvas, const std::vector<LegendEntry>& entries, const PixelBox& box) {
  const TextStyle style;
  // Not rounded: as many lines at every resolution.
  const double line_px = canvas->Px(1.42 * style.size_pt);
  const double sign_px = std::round(canvas->Px(kSign_pt)), gap_px = canvas->Px(kGap_pt);
  const auto rows =
      static_cast<std::size_t>(std::max(1.0, std::floor(box.height / line_px + 1e-6)));
  std::vector<double> columns_px;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i % rows == 0) columns_px.push_back(0);
    columns_px.back() = std::max(columns_px.back(),
                                 sign_px + gap_px + canvas->TextSize(entries[i].text, style).x());
  }
  const double free_px = box.width - std::accumulate(columns_px.begin(), columns_px.end(), 0.0);
  const double most_px =
      columns_px.size() > 1 ? free_px / static_cast<double>(columns_px.size() - 1) : free_px;
  if (free_px < 0 || (columns_px.size() > 1 && most_px < canvas->Px(kLeastColumnGap_pt)))
    return OutputFailed("pictures: the legend does not fit; render a larger picture");
  const double column_gap_px = std::min(most_px, canvas->Px(kColumnGap_pt));
  double left = std::round(box.left);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i > 0 && i % rows == 0) left = std::floor(left + columns_px[i / rows - 1] + column_gap_px);
    const Eigen::Vector2d size = canvas->TextSize(entries[i].text, style);
    const double bottom = std::round(box.Top() - static_cast<double>(i % rows + 1) * line_px);
    const double inset = std::round(0.22 * size.y());
    AddSign(canvas, entries[i], {left, bottom + inset, sign_px, size.y() - 2 * inset});
    canvas->AddText(entries[i].text, {left + sign_px + gap_px, bottom}, style);
  }
  return {};
}

std::string Shortened(const std::string& name) {
  constexpr int kMostCharacters = 24;
  std::string shown;
  int characters = 0;
  for (const char byte : name) {
    const bool starts_character = (static_cast<unsigned char>(byte) & 0xc0U) != 0x80U;  // UTF-8
    if (starts_character && ++characters > kMostCharacters) return shown + "\u2026";
    shown += static_cast<unsigned char>(byte) < 0x20 ? ' ' : byte;
  }
  return shown;
}

std::string CountOf(int count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

double AddTitle(Canvas* canvas, const std::string& title, const std::string& facts) {
  const TextStyle title_style{10, true, kTitleColor}, facts_style{7, false, kFactsColor};
  const double left = canvas->Px(kMargin_pt);
  double bottom = canvas->Height() - canvas->Px(4) - canvas->TextSize(title, title_style).y();
  canvas->AddText(title, {left, bottom}, title_style);
  bottom -= canvas->TextSize(facts, facts_style).y() + canvas->Px(1.5);
  canvas->AddText(facts, {left, bottom}, facts_style);
  return bottom;
}

}  // namespace telestrain::viz
