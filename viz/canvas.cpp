#include "viz/canvas.h"

#include <vtkActor2D.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkImageMapper.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkStdString.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "viz/image_data.h"
#include "viz/offscreen_window.h"
#include "viz/window_keeper.h"

namespace telestrain::viz {
namespace {

void AimCamera(const ParallelCamera& camera, vtkCamera* vtk_camera) {
  const Eigen::Vector3d& focal = camera.focal_in_array_mm;
  const Eigen::Vector3d position = focal + 2 * camera.depth_mm * camera.towards_viewer;
  vtk_camera->ParallelProjectionOn();
  vtk_camera->SetFocalPoint(focal.data());
  vtk_camera->SetPosition(position.data());
  vtk_camera->SetViewUp(camera.up.data());
  vtk_camera->SetParallelScale(camera.half_height_mm);
  vtk_camera->SetClippingRange(camera.depth_mm, 3 * camera.depth_mm);
}

// Display coordinates of array points: VTK's own projection, then the panel's box.
Eigen::Matrix<double, 2, 4> DisplayFromArray(vtkCamera* camera, const PixelBox& box) {
  const vtkMatrix4x4* matrix =
      camera->GetCompositeProjectionTransformMatrix(box.width / box.height, -1, 1);
  Eigen::Matrix<double, 2, 4> display;
  for (int column = 0; column < 4; ++column) {
    const double one = column == 3 ? 1 : 0;
    display(0, column) = 0.5 * box.width * (matrix->GetElement(0, column) + one);
    display(1, column) = 0.5 * box.height * (matrix->GetElement(1, column) + one);
  }
  display.col(3) += Eigen::Vector2d(box.left, box.bottom);
  return display;
}

}  // namespace

Canvas::Canvas(const RenderOptions& options)
    : options_(options),
      dots_per_inch_(options.Dpi()),
      paper_(vtkSmartPointer<vtkRenderer>::New()),
      flat_(vtkSmartPointer<vtkRenderer>::New()),
      label_layer_(vtkSmartPointer<vtkRenderer>::New()),
      overlay_(std::make_unique<Overlay>()),
      leaders_(std::make_unique<Overlay>()) {}

// The window may serve the next canvas, in another thread. What VTK destroys makes the context
// current in this thread again, so all of it goes before the context is let go.
Canvas::~Canvas() {
  if (!window_) return;
  for (const PanelState& state : panels_) window_->RemoveRenderer(state.renderer);
  for (vtkRenderer* renderer : {paper_.Get(), flat_.Get(), label_layer_.Get()})
    window_->RemoveRenderer(renderer);
  panels_.clear();
  paper_ = flat_ = label_layer_ = nullptr;
  overlay_.reset();
  leaders_.reset();
  window_->Release();
}

Result<std::unique_ptr<Canvas>> Canvas::Create(const RenderOptions& options) {
  std::unique_ptr<Canvas> canvas(new Canvas(options));
  TELESTRAIN_RETURN_IF_ERROR(canvas->Open());
  return canvas;
}

Status Canvas::Open() {
  TELESTRAIN_ASSIGN_OR_RETURN(fonts_, FindFontFiles());
  TELESTRAIN_ASSIGN_OR_RETURN(window_, TakeWindow(options_.backend));
  window_->SetSize(options_.width_px, options_.height_px);
  window_->SetDPI(dots_per_inch_);
  window_->SetMultiSamples(0);  // multisampling makes depth-peeled actors vanish
  window_->SetNumberOfLayers(2);
  // VTK would read "$x$" in a view's name as a formula.
  vtkTextRenderer::GetInstance()->SetDefaultBackend(vtkTextRenderer::FreeType);
  // Lines that lie in a surface win over it.
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  paper_->SetBackground(1, 1, 1);
  window_->AddRenderer(paper_);
  flat_->AddActor2D(overlay_->Actor());
  label_layer_->AddActor2D(leaders_->Actor());
  for (vtkRenderer* renderer : {flat_.Get(), label_layer_.Get()}) {
    renderer->SetLayer(1);
    window_->AddRenderer(renderer);
  }
  return {};
}

vtkRenderer* Canvas::AddPanel(const std::string& name, const PixelBox& wanted,
                              const ParallelCamera& camera) {
  const PixelBox box{std::round(wanted.left), std::round(wanted.bottom), std::round(wanted.width),
                     std::round(wanted.height)};
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetViewport(box.left / Width(), box.bottom / Height(), box.Right() / Width(),
                        box.Top() / Height());
  renderer->SetBackground(1, 1, 1);
  renderer->SetUseDepthPeeling(1);
  renderer->SetMaximumNumberOfPeels(40);  // two dozen boards stand behind each other
  renderer->SetOcclusionRatio(0);
  renderer->UseFXAAOn();
  AimCamera(camera, renderer->GetActiveCamera());
  window_->AddRenderer(renderer);
  panels_.push_back({{name, DisplayFromArray(renderer->GetActiveCamera(), box)}, box, renderer});
  return renderer;
}

void Canvas::AddImage(const RgbImage& image, const Eigen::Vector2d& lower_left) {
  vtkNew<vtkImageData> data;
  FillImageData(image, data);
  vtkNew<vtkImageMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetColorWindow(255);  // with the level below: bytes as they are
  mapper->SetColorLevel(127.5);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->SetPosition(std::round(lower_left.x()), std::round(lower_left.y()));
  actor->GetProperty()->SetDisplayLocationToBackground();
  flat_->AddActor2D(actor);
}

const Canvas::PanelState& Canvas::Find(const std::string& panel) const {
  const auto found = std::find_if(panels_.begin(), panels_.end(),
                                  [&](const PanelState& p) { return p.panel.name == panel; });
  TELESTRAIN_CHECK(found != panels_.end(), "no panel " + panel);
  return *found;
}

Eigen::Vector2d Canvas::DisplayOf(const std::string& panel,
                                  const Eigen::Vector3d& point_in_array_mm) const {
  return Find(panel).panel.PixelOf(point_in_array_mm);
}

vtkSmartPointer<vtkTextProperty> Canvas::PropertyOf(const TextStyle& style) const {
  auto property = vtkSmartPointer<vtkTextProperty>::New();
  property->SetFontFamily(VTK_FONT_FILE);
  property->SetFontFile((style.bold ? fonts_.bold : fonts_.regular).c_str());
  // VTK's sizes are whole points; the picture's resolution makes them about 4 px steps.
  property->SetFontSize(static_cast<int>(std::lround(style.size_pt)));
  property->SetColor(style.color.r, style.color.g, style.color.b);
  property->BoldOff();
  property->ItalicOff();
  property->ShadowOff();
  property->SetJustificationToLeft();
  property->SetVerticalJustificationToBottom();
  return property;
}

Eigen::Vector2d Canvas::TextSize(const std::string& text, const TextStyle& style) const {
  int box[4] = {0, 0, 0, 0};
  vtkTextRenderer::GetInstance()->GetBoundingBox(PropertyOf(style), text, box, dots_per_inch_);
  return {box[1] - box[0] + 1.0, box[3] - box[2] + 1.0};
}

void Canvas::AddText(const std::string& text, const Eigen::Vector2d& at, const TextStyle& style) {
  AddText(text, at, style, flat_);
}

void Canvas::AddText(const std::string& text, const Eigen::Vector2d& at, const TextStyle& style,
                     vtkRenderer* layer) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->GetTextProperty()->ShallowCopy(PropertyOf(style));
  actor->SetTextScaleModeToNone();
  actor->GetPositionCoordinate()->SetCoordinateSystemToViewport();
  const double left = std::round(at.x()), bottom = std::round(at.y());
  actor->SetPosition(left, bottom);
  layer->AddActor2D(actor);
  const Eigen::Vector2d size = TextSize(text, style);
  texts_.push_back({text, style.size_pt, {left, bottom, size.x(), size.y()}});
}

}  // namespace telestrain::viz
