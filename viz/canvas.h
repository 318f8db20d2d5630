#pragma once

#include <vtkSmartPointer.h>

#include <memory>
#include <string>
#include <vector>

#include "viz/font_files.h"
#include "viz/overlay.h"
#include "viz/pictures.h"
#include "viz/vtk_messages.h"

class vtkRenderer;
class vtkTextProperty;

namespace telestrain::viz {

class OffscreenWindow;

struct TextStyle {
  double size_pt = 7;  // 7 is the smallest that the pictures use
  bool bold = false;
  Rgb color{0.13, 0.15, 0.18};
};

// A text that belongs to a point of a panel's scene: drawn beside it on free paper, with a leader.
struct Label {
  std::string text;
  Eigen::Vector3d anchor_in_array_mm = Eigen::Vector3d::Zero();
  double preferred_deg = 90;  // direction of the text seen from the point, 0 to the right
  TextStyle style;
  bool leader = true;
};

// A picture under construction: panels with cameras, flat shapes and texts over them. Positions in
// px from the lower left corner; sizes on paper in pt = 1/72 inch. Holds the right to use VTK.
class Canvas {
 public:
  // Opens the off-screen window; fails (kOutputFailed) with the reason.
  static Result<std::unique_ptr<Canvas>> Create(const RenderOptions& options);
  ~Canvas();

  double Width() const { return options_.width_px; }
  double Height() const { return options_.height_px; }
  double Px(double pt) const { return pt * dots_per_inch_ / 72.0; }

  // The box is rounded to whole pixels. The renderer belongs to the canvas.
  vtkRenderer* AddPanel(const std::string& name, const PixelBox& box, const ParallelCamera& camera);
  Eigen::Vector2d DisplayOf(const std::string& panel,
                            const Eigen::Vector3d& point_in_array_mm) const;

  // Pixels as they are, `lower_left` rounded, below shapes and texts.
  void AddImage(const RgbImage& image, const Eigen::Vector2d& lower_left);
  Overlay& Shapes() { return *overlay_; }
  Eigen::Vector2d TextSize(const std::string& text, const TextStyle& style) const;
  // `at`: lower left corner of the text's box.
  void AddText(const std::string& text, const Eigen::Vector2d& at, const TextStyle& style);
  // The label goes inside the panel's box, where nothing else is drawn when the picture is
  // finished.
  void AddLabel(const std::string& panel, const Label& label);

  // Renders the scene, sees where labels have room and draws them on top; once more on black paper
  // for a transparent picture. Fails (kOutputFailed) with what VTK reported, or when a label finds
  // no room: without it the picture is not understood.
  Result<Picture> Finish();

 private:
  struct PanelState {
    Panel panel;
    PixelBox box;
    vtkSmartPointer<vtkRenderer> renderer;
  };
  explicit Canvas(const RenderOptions& options);
  Status Open();
  const PanelState& Find(const std::string& panel) const;
  vtkSmartPointer<vtkTextProperty> PropertyOf(const TextStyle& style) const;
  void AddText(const std::string& text, const Eigen::Vector2d& at, const TextStyle& style,
               vtkRenderer* layer);
  Result<RgbImage> Grab();
  Result<RgbImage> GrabWithLabels();
  Result<RgbImage> GrabOnBlack();
  Status PlaceLabels(const RgbImage& image);
  void AddLeader(const Eigen::Vector2d& anchor_px, const PixelBox& text);

  VtkMessages messages_;  // first: held until the window is gone
  RenderOptions options_;
  int dots_per_inch_ = 300;
  FontFiles fonts_;
  vtkSmartPointer<OffscreenWindow> window_;
  vtkSmartPointer<vtkRenderer> paper_;        // below everything
  vtkSmartPointer<vtkRenderer> flat_;         // over everything
  vtkSmartPointer<vtkRenderer> label_layer_;  // over that
  std::unique_ptr<Overlay> overlay_, leaders_;
  std::vector<PanelState> panels_;
  std::vector<std::pair<std::string, Label>> labels_;  // panel and label
  std::vector<PlacedText> texts_;
};

}  // namespace telestrain::viz
