#include "viz/desk/desk_panel.h"

#include <algorithm>
#include <cmath>

namespace telestrain::viz {
namespace {

constexpr Rgb kPanelColor{0.955, 0.960, 0.965}, kLineColor{0.78, 0.80, 0.83},
    kFaint{0.38, 0.41, 0.45}, kActive{0.00, 0.45, 0.70};
const FlatText kTitle{11, true}, kHeading{9, true, kFaint}, kText{9}, kName{9, false, kFaint},
    kSmall{8}, kNote{8, false, kFaint};

// Writes from the top of the box downwards.
class PanelWriter {
 public:
  PanelWriter(const DeskModel& model, const PixelBox& box, FlatSheet* sheet)
      : model_(model),
        sheet_(sheet),
        left_(box.left + sheet->Px(9)),
        width_(box.width - sheet->Px(18)),
        top_(box.Top() - sheet->Px(8)),
        bottom_(box.bottom + sheet->Px(6)) {
    sheet->Shapes().AddBox(box, kPanelColor);
    sheet->Shapes().AddBox({box.left, box.bottom, 1, box.height}, kLineColor);
  }

  void Gap(double points) { top_ -= sheet_->Px(points); }
  void Line(const std::string& text, const FlatText& style) {
    top_ -= sheet_->LineHeight(style);
    sheet_->AddText(sheet_->Fitted(text, style, width_), {left_, top_ + sheet_->Px(1.5)}, style);
  }
  void Heading(const std::string& text) {
    Gap(7);
    sheet_->Shapes().AddBox({left_, std::round(top_), width_, 1}, kLineColor);
    Gap(2);
    Line(text, kHeading);
    Gap(1);
  }

  void Slider();
  void Bar(const ValueBar& bar);
  void QuantityChoice();
  void Layers();
  void Facts(const std::vector<Fact>& facts);
  std::vector<HotArea> Areas() const { return areas_; }

 private:
  void Ticks(const ValueBar& bar);
  void LayerRow(Layer layer, double left, double width);

  const DeskModel& model_;
  FlatSheet* sheet_;
  double left_, width_, top_, bottom_;
  std::vector<HotArea> areas_;
};

// A track with a mark per state and a knob on the shown one.
void PanelWriter::Slider() {
  const int states = model_.States();
  if (states < 2) return;
  const double height = sheet_->Px(14), step = width_ / states;
  top_ -= height;
  const double middle = std::round(top_ + 0.5 * height);
  const auto at = [&](int state) { return std::round(left_ + (state + 0.5) * step); };
  Overlay& shapes = sheet_->Shapes();
  shapes.AddBox({at(0), middle - 1, at(states - 1) - at(0), 2}, kLineColor);
  // Of many states only some get a mark, so that marks stay apart.
  const int every = std::max(1, static_cast<int>(std::ceil(sheet_->Px(4) / step)));
  for (int i = 0; i < states; ++i) {
    if (i % every == 0)
      shapes.AddBox({at(i) - 1, middle - sheet_->Px(2.5), 2, sheet_->Px(5)}, kFaint);
    areas_.push_back({{left_ + i * step, top_, step, height}, DeskAction::kShowState, i});
  }
  const double knob = sheet_->Px(4), x = at(static_cast<int>(model_.shown()->state));
  shapes.AddBox({x - knob, middle - sheet_->Px(5.5), 2 * knob, sheet_->Px(11)}, kActive);
}

// Numbers at every n-th tick, so that they stay apart.
void PanelWriter::Ticks(const ValueBar& bar) {
  const std::vector<double>& ticks = bar.scale.ticks;
  double widest = 0;
  for (const double tick : ticks)
    widest = std::max(
        widest, sheet_->TextSize(NumberText(tick, bar.scale.decimals), kSmall).x() + sheet_->Px(4));
  const double apart = width_ / std::max<double>(1, static_cast<double>(ticks.size()) - 1);
  // The numbers at the ends are moved inwards by half of their width.
  const auto stride = static_cast<std::size_t>(std::ceil(1.5 * widest / apart));
  const double text_top = top_ - sheet_->Px(2);
  top_ -= sheet_->Px(2) + sheet_->LineHeight(kSmall);
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    const double x = left_ + width_ * (ticks[i] - bar.scale.low) / (bar.scale.high - bar.scale.low);
    const double line = std::round(std::min(x, left_ + width_ - 1));
    sheet_->Shapes().AddBox({line, text_top, 1, sheet_->Px(2)}, kFaint);
    if (i % stride != 0) continue;
    const std::string text = NumberText(ticks[i], bar.scale.decimals);
    const double width = sheet_->TextSize(text, kSmall).x();
    const double from = std::clamp(x - 0.5 * width, left_, left_ + width_ - width);
    sheet_->AddText(text, {from, top_ + sheet_->Px(1)}, kSmall);
  }
}

void PanelWriter::Bar(const ValueBar& bar) {
  Line(bar.title, kText);
  if (!bar.note.empty()) Line(bar.note, kNote);
  Gap(2);
  const double height = std::round(sheet_->Px(9));
  top_ = std::round(top_ - height);
  for (int i = 0; i < ColorMap::kEntries; ++i) {
    const double from = std::round(left_ + width_ * i / ColorMap::kEntries);
    const double to = std::round(left_ + width_ * (i + 1) / ColorMap::kEntries);
    sheet_->Shapes().AddBox({from, top_, to - from, height},
                            bar.colors.table()[static_cast<std::size_t>(i)]);
  }
  Ticks(bar);
  Gap(2);
}

// Two arrows that step through the quantities, as the keys do.
void PanelWriter::QuantityChoice() {
  if (model_.quantities().size() < 2) return;
  const double height = sheet_->LineHeight(kText), half = 0.5 * width_;
  Line("\u25c2 previous", kName);
  areas_.push_back({{left_, top_, half, height}, DeskAction::kStepQuantity, -1});
  const std::string next = "next \u25b8";
  sheet_->AddText(
      next, {left_ + width_ - sheet_->TextSize(next, kName).x(), top_ + sheet_->Px(1.5)}, kName);
  areas_.push_back({{left_ + half, top_, half, height}, DeskAction::kStepQuantity, 1});
}

void PanelWriter::LayerRow(Layer layer, double left, double width) {
  const double height = sheet_->LineHeight(kText), side = std::round(sheet_->Px(6.5));
  const PixelBox square{std::round(left), std::round(top_ + 0.5 * (height - side)), side, side};
  const bool shown = model_.Shows(layer);
  sheet_->Shapes().AddBox(square, shown ? kActive : Rgb{1, 1, 1});
  sheet_->Shapes().AddFrame(square, kFaint, 1);
  const double text_left = left + side + sheet_->Px(4);
  const std::string key(1, static_cast<char>(KeyOf(layer) - 'a' + 'A'));
  sheet_->AddText(key, {text_left, top_ + sheet_->Px(1.5)}, kHeading);
  sheet_->AddText(NameOf(layer), {text_left + sheet_->Px(11), top_ + sheet_->Px(1.5)},
                  shown ? kText : kName);
  areas_.push_back(
      {{left, top_, width, height}, DeskAction::kToggleLayer, static_cast<int>(layer)});
}

void PanelWriter::Layers() {
  std::vector<Layer> layers;
  for (const Layer layer : kAllLayers)
    if (model_.Has(layer)) layers.push_back(layer);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (i % 2 == 0) top_ -= sheet_->LineHeight(kText);
    LayerRow(layers[i], left_ + (i % 2 == 0 ? 0 : 0.5 * width_), 0.5 * width_);
  }
}

// Name and value side by side where they fit, else the value below the name.
void PanelWriter::Facts(const std::vector<Fact>& facts) {
  const double line = sheet_->LineHeight(kText), gap = sheet_->Px(5);
  for (const Fact& fact : facts) {
    const double name_width = sheet_->TextSize(fact.name, kName).x();
    const double value_width = sheet_->TextSize(fact.value, kText).x();
    const bool beside = name_width + gap + value_width <= width_;
    if (top_ - (beside ? line : 2 * line) < bottom_) {
      if (top_ - line >= bottom_) Line("\u2026", kName);
      return;
    }
    Line(fact.name, kName);
    if (beside)
      sheet_->AddText(fact.value, {left_ + width_ - value_width, top_ + sheet_->Px(1.5)}, kText);
    else
      Line("  " + fact.value, kText);
  }
}

}  // namespace

char KeyOf(Layer layer) {
  switch (layer) {
    case Layer::kViews:
      return 'v';
    case Layer::kOptics:
      return 'o';
    case Layer::kBoards:
      return 'b';
    case Layer::kRulers:
      return 'r';
    case Layer::kPipe:
      return 'p';
    case Layer::kSurface:
      return 'm';
    case Layer::kDisplacements:
      return 'd';
    case Layer::kGauges:
      return 'g';
    case Layer::kUncertainty:
      return 'u';
    case Layer::kFrame:
      break;
  }
  return 'f';
}

std::vector<HotArea> DrawPanel(const DeskModel& model, const PanelContent& content,
                               const PixelBox& box, FlatSheet* sheet) {
  PanelWriter panel(model, box, sheet);
  panel.Line(model.title(), kTitle);
  for (const std::string& line : model.StateLines()) panel.Line(line, kText);
  panel.Slider();
  const auto bars = model.Bars();
  if (!bars.empty()) panel.Heading("COLOURS");
  for (std::size_t i = 0; i < bars.size(); ++i) {
    panel.Bar(bars[i]);
    if (i == 0 && model.Shows(Layer::kSurface)) panel.QuantityChoice();
  }
  panel.Heading("LAYERS");
  panel.Layers();
  panel.Heading(content.picked_title.empty() ? "POINT AT SOMETHING, CLICK TO KEEP IT" : "PICKED");
  if (!content.picked_title.empty()) panel.Line(content.picked_title, FlatText{9, true});
  panel.Facts(content.facts);
  return panel.Areas();
}

}  // namespace telestrain::viz
