#include "viz/field_picture.h"

#include <algorithm>
#include <cmath>

#include "base/numbers.h"
#include "viz/color_bar.h"
#include "viz/field_colors.h"
#include "viz/field_marks.h"
#include "viz/legend.h"
#include "viz/scene/scene_colors.h"
#include "viz/scene_marks.h"

namespace telestrain::viz {
namespace {

constexpr int kWidth_px = 2008;
constexpr double kPx_per_pt = 300 / 72.0;
constexpr double kMargin_pt = 6, kTitle_pt = 18, kLine_pt = 10, kAxis_pt = 30, kFooter_pt = 42;
constexpr double kLeft_pt = 30;  // room for the numbers of the vertical scale
constexpr double kBarShare = 0.42;
constexpr double kEdge_pt = 1.0, kTick_pt = 2.5;
constexpr Rgb kQuiet{0.33, 0.38, 0.44};

// "0.05", "20": a round number with the digits that it needs.
std::string RoundText(double value) {
  return FormatFixed(value, std::max(0, static_cast<int>(-std::floor(std::log10(value) + 1e-9))));
}

std::vector<std::string> CharactersOf(const std::string& text) {
  std::vector<std::string> characters;
  for (const char byte : text) {
    const bool continues = (static_cast<unsigned char>(byte) & 0xc0U) == 0x80U;  // UTF-8
    if (continues && !characters.empty())
      characters.back() += byte;
    else
      characters.emplace_back(1, static_cast<unsigned char>(byte) < 0x20 ? ' ' : byte);
  }
  return characters;
}

// The text without as many of its middle characters as it takes to fit.
std::string Fitting(const Canvas& canvas, const std::string& text, const TextStyle& style,
                    double width_px) {
  if (canvas.TextSize(text, style).x() <= width_px) return text;
  const auto characters = CharactersOf(text);
  for (std::size_t kept = characters.size() - 1; kept > 0; --kept) {
    std::string shown;
    for (std::size_t i = 0; i < (kept + 1) / 2; ++i) shown += characters[i];
    shown += "\u2026";
    for (std::size_t i = characters.size() - kept / 2; i < characters.size(); ++i)
      shown += characters[i];
    if (canvas.TextSize(shown, style).x() <= width_px) return shown;
  }
  return "\u2026";
}

int PictureHeight(const ImageBackdrop& backdrop, const FieldScene& scene) {
  const auto lines = static_cast<double>(scene.facts.size() + scene.notes.size());
  const double texts_pt = 2 * kMargin_pt + kTitle_pt + kLine_pt * lines + kAxis_pt + kFooter_pt;
  return backdrop.height() + static_cast<int>(std::ceil(kPx_per_pt * texts_pt));
}

class FieldDrawing {
 public:
  FieldDrawing(Canvas* canvas, const ImageBackdrop& backdrop, const FieldScene& scene)
      : canvas_(canvas), backdrop_(backdrop), scene_(scene), scale_(FieldScale(scene)) {}

  // Where the image lies: pixel of the picture = matrix (x, y, 0, 1) of the image.
  Panel Draw() {
    double top = AddHeading();
    const double left_px = canvas_->Px(kLeft_pt);
    const double room_px = canvas_->Width() - left_px - canvas_->Px(kMargin_pt);
    const Eigen::Vector2d upper_left(
        std::round(left_px + std::max(0.0, 0.5 * (room_px - backdrop_.width()))), std::round(top));
    AddImage(upper_left);
    AddScales(upper_left);
    top = upper_left.y() - backdrop_.height() - canvas_->Px(kAxis_pt - kLine_pt);
    const double width = canvas_->Width() - 2 * canvas_->Px(kMargin_pt);
    AddColorBar(canvas_, Colors(), scale_, scene_.value_name,
                {canvas_->Px(2.5 * kMargin_pt), top - canvas_->Px(kFooter_pt),
                 kBarShare * width - canvas_->Px(5 * kMargin_pt), canvas_->Px(kFooter_pt)});
    AddKey({canvas_->Px(kMargin_pt) + kBarShare * width, top});
    AddNotes();
    return ImagePanel(upper_left);
  }

 private:
  Panel ImagePanel(const Eigen::Vector2d& upper_left) const {
    Panel panel{"image", Eigen::Matrix<double, 2, 4>::Zero()};
    const double scale = backdrop_.magnification();
    panel.pixel_from_array.leftCols<2>() = scale * Eigen::Matrix2d::Identity();
    panel.pixel_from_array.col(3) << upper_left.x() + 0.5 * scale - 0.5,
        canvas_->Height() - upper_left.y() + 0.5 * scale - 0.5;
    return panel;
  }

  ColorMap Colors() const { return ColorMap::Viridis(scale_.low, scale_.high); }

  // The lower edge of the texts.
  double AddHeading() {
    const TextStyle title{10, true, {0.08, 0.19, 0.31}}, facts{7, false, kQuiet};
    const double left = canvas_->Px(kMargin_pt), width = canvas_->Width() - 2 * left;
    double bottom = canvas_->Height() - canvas_->Px(kTitle_pt);
    canvas_->AddText(Fitting(*canvas_, scene_.title, title, width), {left, bottom}, title);
    for (const std::string& line : scene_.facts) {
      bottom -= canvas_->Px(kLine_pt);
      canvas_->AddText(Fitting(*canvas_, line, facts, width), {left, bottom}, facts);
    }
    return bottom - canvas_->Px(kMargin_pt);
  }

  void AddImage(const Eigen::Vector2d& upper_left) {
    const int edge_px = static_cast<int>(std::lround(canvas_->Px(kEdge_pt)));
    const PixelBox box{upper_left.x(), upper_left.y() - backdrop_.height(),
                       static_cast<double>(backdrop_.width()),
                       static_cast<double>(backdrop_.height())};
    canvas_->AddImage(ColoredBackdrop(backdrop_, scene_, Colors(), edge_px),
                      {box.left, box.bottom});
    canvas_->Shapes().AddFrame(box.Grown(std::round(canvas_->Px(0.5))), kInk, canvas_->Px(0.5));
    const FieldMarks marks(canvas_, backdrop_, scene_, upper_left);
    if (scene_.grid_dots) dots_ = marks.AddGridDots();
    if (scene_.arrows) arrows_ = marks.AddArrows();
    failures_ = marks.AddFailures();
    marks.AddSubset();
  }

  // The scales' numbers are px of the image.
  void AddScales(const Eigen::Vector2d& upper_left) {
    const TextStyle style;
    const double lowest = upper_left.y() - backdrop_.height();
    const double tick = canvas_->Px(kTick_pt), line = std::max(1.0, std::round(canvas_->Px(0.5)));
    constexpr double kLeastTickDistance_pt = 36;
    const double step = RoundUp(canvas_->Px(kLeastTickDistance_pt) / backdrop_.magnification());
    Overlay& shapes = canvas_->Shapes();
    for (double at = 0; at < backdrop_.image_width_px(); at += step) {
      const double x = std::round(upper_left.x() + backdrop_.BackdropPlace({at, 0}).x());
      shapes.AddBox({x, lowest - tick, line, tick}, kInk);
      const std::string text = FormatFixed(at, 0);
      const Eigen::Vector2d size = canvas_->TextSize(text, style);
      canvas_->AddText(text, {x - 0.5 * size.x(), lowest - tick - size.y() - canvas_->Px(0.5)},
                       style);
    }
    for (double at = 0; at < backdrop_.image_height_px(); at += step) {
      const double y = std::round(upper_left.y() - backdrop_.BackdropPlace({0, at}).y());
      shapes.AddBox({upper_left.x() - tick, y, tick, line}, kInk);
      const std::string text = FormatFixed(at, 0);
      const Eigen::Vector2d size = canvas_->TextSize(text, style);
      canvas_->AddText(
          text, {upper_left.x() - tick - size.x() - canvas_->Px(1), y - 0.5 * size.y()}, style);
    }
    const double right = upper_left.x() + backdrop_.width();
    const std::string name = "x, y / px";
    canvas_->AddText(
        name,
        {right - canvas_->TextSize(name, style).x(), lowest - canvas_->Px(kAxis_pt - kLine_pt - 1)},
        style);
  }

  static double RoundUp(double value) {
    const double below = RoundDown(value);
    for (const double factor : {1.0, 2.0, 2.5, 5.0})
      if (const double step = RoundDown(factor * below); step >= value) return std::max(1.0, step);
    return std::max(1.0, 10 * below);
  }

  // What the signs mean, in lines from `upper_left` downwards.
  void AddKey(const Eigen::Vector2d& upper_left) {
    const FieldMarks marks(canvas_, backdrop_, scene_, upper_left);
    const double line_px = canvas_->Px(kLine_pt), sign_px = canvas_->Px(26);
    Eigen::Vector2d at = upper_left - Eigen::Vector2d(0, 0.5 * line_px);
    const auto add = [&](const std::string& text) {
      const TextStyle style;
      const double height = canvas_->TextSize(text, style).y();
      canvas_->AddText(text, {at.x() + sign_px, at.y() - 0.5 * height}, style);
      at.y() -= line_px;
    };
    const Eigen::Vector2d middle(0.42 * sign_px, 0);
    if (arrows_.enlarged > 0) {
      const double length = arrows_.enlarged * marks.PicturePx(arrows_.length_px);
      const Eigen::Vector2d half(0.5 * std::min(length, 0.84 * sign_px), 0);
      AddFlatArrow(canvas_, at + middle - half, at + middle + half);
      add(ArrowText(length > 0.84 * sign_px));
    }
    marks.AddSquare(at + middle, std::min(marks.PicturePx(scene_.subset_px), 0.6 * line_px));
    add("subset " + std::to_string(scene_.subset_px) + " \u00d7 " +
        std::to_string(scene_.subset_px) + " px, drawn to scale once; points every " +
        std::to_string(scene_.step_px) + " px" + (dots_ ? " (dots)" : ""));
    if (failures_ > 0) marks.AddCross(at + middle);
    add(failures_ > 0 ? CountOf(failures_, "point") + " without result: " + scene_.failure
                      : "no point without result");
    if (!scene_.inside) return;
    canvas_->Shapes().AddLine(at + 0.3 * middle, at + 1.7 * middle, kFieldEdge,
                              canvas_->Px(kEdge_pt));
    add("edge of the region; the rest is faded");
  }

  std::string ArrowText(bool is_sign_only) const {
    return (is_sign_only ? "displacement, arrows "
                         : RoundText(arrows_.length_px) + " px; arrows ") +
           RoundText(arrows_.enlarged) + " \u00d7 enlarged, from the point on";
  }

  void AddNotes() {
    const TextStyle style{7, false, kQuiet};
    const double left = canvas_->Px(kMargin_pt);
    double bottom = canvas_->Px(kMargin_pt + kLine_pt * static_cast<double>(scene_.notes.size()));
    for (const std::string& note : scene_.notes) {
      bottom -= canvas_->Px(kLine_pt);
      canvas_->AddText(Fitting(*canvas_, note, style, canvas_->Width() - 2 * left), {left, bottom},
                       style);
    }
  }

  Canvas* canvas_;
  const ImageBackdrop& backdrop_;
  const FieldScene& scene_;
  ColorScale scale_;
  FieldMarks::ArrowKey arrows_;
  int failures_ = 0;
  bool dots_ = false;
};

}  // namespace

// A hundredth of the points at either end may be noise of single subsets.
ColorScale FieldScale(const FieldScene& scene) {
  std::vector<double> values;
  for (const FieldSample& sample : scene.samples)
    if (std::isfinite(sample.value)) values.push_back(sample.value);
  return ScaleFor(std::move(values), 0.01);
}

Result<Picture> DrawField(const ImageBackdrop& backdrop, const FieldScene& scene) {
  TELESTRAIN_ASSIGN_OR_RETURN(const auto canvas,
                              Canvas::Create({kWidth_px, PictureHeight(backdrop, scene)}));
  const Panel image = FieldDrawing(canvas.get(), backdrop, scene).Draw();
  TELESTRAIN_ASSIGN_OR_RETURN(Picture picture, canvas->Finish());
  picture.panels.push_back(image);
  return picture;
}

}  // namespace telestrain::viz
