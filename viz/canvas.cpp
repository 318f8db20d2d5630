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
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "viz/image_data.h"
#include "viz/label_layout.h"
#include "viz/offscreen_window.h"

namespace telestrain::viz {
namespace {

constexpr double kPaperWidth_mm = 170;  // the report's text width
constexpr double kInch_mm = 25.4;

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

// 1 where the picture is not white, rows from the bottom.
std::vector<std::uint8_t> TakenPixels(const RgbImage& image) {
  std::vector<std::uint8_t> taken(image.rgb.size() / 3);
  const auto width = static_cast<std::size_t>(image.width_px);
  const auto height = static_cast<std::size_t>(image.height_px);
  constexpr int kWhite = 3 * 252;  // fainter than this nobody sees
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const std::uint8_t* rgb = &image.rgb[3 * ((height - 1 - y) * width + x)];
      taken[y * width + x] = rgb[0] + rgb[1] + rgb[2] < kWhite ? 1 : 0;
    }
  return taken;
}

}  // namespace

Canvas::Canvas(const RenderOptions& options)
    : options_(options),
      dots_per_inch_(static_cast<int>(std::lround(options.width_px * kInch_mm / kPaperWidth_mm))),
      flat_(vtkSmartPointer<vtkRenderer>::New()),
      overlay_(std::make_unique<Overlay>()) {}

Canvas::~Canvas() = default;

Result<std::unique_ptr<Canvas>> Canvas::Create(const RenderOptions& options) {
  std::unique_ptr<Canvas> canvas(new Canvas(options));
  TELESTRAIN_RETURN_IF_ERROR(canvas->Open());
  return canvas;
}

Status Canvas::Open() {
  TELESTRAIN_ASSIGN_OR_RETURN(fonts_, FindFontFiles());
  OffscreenWindow::RegisterFactory();
  window_ = vtkSmartPointer<OffscreenWindow>::New();
  TELESTRAIN_RETURN_IF_ERROR(window_->Open());
  window_->SetSize(options_.width_px, options_.height_px);
  window_->SetDPI(dots_per_inch_);
  window_->SetMultiSamples(0);  // multisampling makes depth-peeled actors vanish
  window_->SetNumberOfLayers(2);
  // VTK would read "$x$" in a view's name as a formula.
  vtkTextRenderer::GetInstance()->SetDefaultBackend(vtkTextRenderer::FreeType);
  // Lines that lie in a surface win over it.
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  vtkNew<vtkRenderer> paper;
  paper->SetBackground(1, 1, 1);
  window_->AddRenderer(paper);
  flat_->SetLayer(1);
  flat_->AddActor2D(overlay_->Actor());
  window_->AddRenderer(flat_);
  return {};
}

vtkRenderer* Canvas::AddPanel(const std::string& name, const PixelBox& wanted,
                              const ParallelCamera& camera) {
  const PixelBox box{std::round(wanted.left), std::round(wanted.bottom), std::round(wanted.width),
                     std::round(wanted.height)};
  vtkNew<vtkRenderer> renderer;
  renderer->SetViewport(box.left / Width(), box.bottom / Height(), box.Right() / Width(),
                        box.Top() / Height());
  renderer->SetBackground(1, 1, 1);
  renderer->SetUseDepthPeeling(1);
  renderer->SetMaximumNumberOfPeels(40);  // two dozen boards stand behind each other
  renderer->SetOcclusionRatio(0);
  renderer->UseFXAAOn();
  AimCamera(camera, renderer->GetActiveCamera());
  window_->AddRenderer(renderer);
  panels_.push_back({{name, DisplayFromArray(renderer->GetActiveCamera(), box)}, box});
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
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->GetTextProperty()->ShallowCopy(PropertyOf(style));
  actor->SetTextScaleModeToNone();
  actor->GetPositionCoordinate()->SetCoordinateSystemToViewport();
  const double left = std::round(at.x()), bottom = std::round(at.y());
  actor->SetPosition(left, bottom);
  flat_->AddActor2D(actor);
  const Eigen::Vector2d size = TextSize(text, style);
  texts_.push_back({text, style.size_pt, {left, bottom, size.x(), size.y()}});
}

void Canvas::AddLeader(const Eigen::Vector2d& anchor_px, const PixelBox& text) {
  const double gap_px = Px(1.5);
  const PixelBox near = text.Grown(gap_px);
  const Eigen::Vector2d end(std::clamp(anchor_px.x(), near.left, near.Right()),
                            std::clamp(anchor_px.y(), near.bottom, near.Top()));
  if ((end - anchor_px).norm() < Px(3)) return;
  overlay_->AddLine(anchor_px, end, {0.35, 0.38, 0.42}, Px(0.5));
}

void Canvas::AddLabel(const std::string& panel, const Label& label) {
  labels_.emplace_back(panel, label);
}

Status Canvas::PlaceLabels(const RgbImage& image) {
  const Occupancy occupancy(image.width_px, image.height_px, TakenPixels(image));
  std::vector<PixelBox> placed;
  for (const auto& [panel, label] : labels_) {
    LabelRequest request;
    request.anchor_px = DisplayOf(panel, label.anchor_in_array_mm);
    request.size_px = TextSize(label.text, label.style);
    request.preferred_rad = label.preferred_deg * std::numbers::pi / 180;
    request.clearance_px = Px(1.5);
    request.leader = label.leader;
    request.straight_px = (label.leader ? 3.0 : 2.0) * request.size_px.y();
    const auto box = PlaceLabel(request, Find(panel).box, occupancy, placed);
    if (!box)
      return OutputFailed("pictures: no room for the label '" + label.text +
                          "'; render a larger picture");
    placed.push_back(box->Grown(request.clearance_px));
    AddText(label.text, {box->left, box->bottom}, label.style);
    if (!label.leader) continue;
    AddLeader(request.anchor_px, *box);
    for (const PixelBox& part : LeaderBoxes(request.anchor_px, *box, request.clearance_px))
      placed.push_back(part);
  }
  labels_.clear();
  return {};
}

Result<RgbImage> Canvas::Grab() {
  window_->Render();
  RgbImage image{options_.width_px, options_.height_px, dots_per_inch_, {}};
  vtkNew<vtkUnsignedCharArray> pixels;
  window_->GetPixelData(0, 0, image.width_px - 1, image.height_px - 1, 0, pixels, 0);
  if (const std::string problem = messages_.FirstError(); !problem.empty())
    return OutputFailed("pictures: rendering failed: " + problem);
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(image.width_px);
  const std::size_t bytes = row_bytes * static_cast<std::size_t>(image.height_px);
  if (static_cast<std::size_t>(pixels->GetNumberOfValues()) != bytes)
    return OutputFailed("pictures: rendering gave no pixels; is there enough memory?");
  image.rgb.resize(bytes);
  for (std::size_t y = 0; y < static_cast<std::size_t>(image.height_px); ++y)
    std::copy_n(pixels->GetPointer(0) + bytes - (y + 1) * row_bytes, row_bytes,
                image.rgb.begin() + static_cast<std::ptrdiff_t>(y * row_bytes));
  return image;
}

Result<Picture> Canvas::Finish() {
  Picture picture;
  if (!labels_.empty()) {
    TELESTRAIN_ASSIGN_OR_RETURN(const RgbImage without_labels, Grab());
    TELESTRAIN_RETURN_IF_ERROR(PlaceLabels(without_labels));
  }
  TELESTRAIN_ASSIGN_OR_RETURN(picture.image, Grab());
  for (const PanelState& state : panels_) {
    Panel panel = state.panel;
    // From VTK's display (edges between pixels, y up) to pixels (centres, y down).
    panel.pixel_from_array.row(1) *= -1;
    panel.pixel_from_array.col(3) += Eigen::Vector2d(-0.5, Height() - 0.5);
    picture.panels.push_back(panel);
  }
  picture.texts = texts_;
  return picture;
}

}  // namespace telestrain::viz
