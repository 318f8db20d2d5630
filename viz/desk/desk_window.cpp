#include "viz/desk/desk_window.h"

#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkTextRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/numbers.h"
#include "viz/desk/x_display.h"
#include "viz/scene/scene_colors.h"
#include "viz/vtk_messages.h"

namespace telestrain::viz {
namespace {

constexpr double kPanelWidth_pt = 240;

// Screens tell their resolution badly; outside of these texts would be too small or too large.
constexpr int kLeastDpi = 96, kMostDpi = 192;

}  // namespace

DeskWindow::DeskWindow(const DeskModel* model) : model_(model) {}

Result<std::unique_ptr<DeskWindow>> DeskWindow::Open(const DeskModel* model, int width_px,
                                                     int height_px) {
  std::unique_ptr<DeskWindow> window(new DeskWindow(model));
  TELESTRAIN_RETURN_IF_ERROR(window->Make(width_px, height_px));
  return window;
}

DeskWindow::~DeskWindow() {
  if (window_ == nullptr) return;
  window_->RemoveObserver(before_frame_);
  // Window and interactor hold each other.
  if (const vtkSmartPointer<vtkRenderWindowInteractor> interactor = window_->GetInteractor()) {
    window_->SetInteractor(nullptr);
    interactor->SetRenderWindow(nullptr);
  }
  window_->Finalize();  // while the connection to the X server stands
}

Status DeskWindow::Make(int width_px, int height_px) {
  TELESTRAIN_ASSIGN_OR_RETURN(display_, OpenDisplay());
  TELESTRAIN_ASSIGN_OR_RETURN(const FontFiles fonts, FindFontFiles());
  window_ = vtkSmartPointer<vtkRenderWindow>::New();
  window_->SetDisplayId(display_.get());
  window_->SetWindowName(("telestrain-view " + model_->title()).c_str());
  window_->SetSize(width_px, height_px);
  window_->DetectDPI();
  window_->SetDPI(std::clamp(window_->GetDPI(), kLeastDpi, kMostDpi));
  window_->SetMultiSamples(0);  // multisampling makes depth-peeled actors vanish
  window_->SetNumberOfLayers(2);
  // VTK would read "$x$" in a view's name as a formula.
  vtkTextRenderer::GetInstance()->SetDefaultBackend(vtkTextRenderer::FreeType);
  // Lines that lie in a surface win over it.
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  scene_ = vtkSmartPointer<vtkRenderer>::New();
  scene_->SetBackground(1, 1, 1);
  scene_->SetUseDepthPeeling(1);
  scene_->SetMaximumNumberOfPeels(20);
  scene_->SetOcclusionRatio(0);
  scene_->UseFXAAOn();
  scene_->GetActiveCamera()->ParallelProjectionOn();
  window_->AddRenderer(scene_);
  flat_ = vtkSmartPointer<vtkRenderer>::New();
  flat_->SetLayer(1);
  flat_->InteractiveOff();
  window_->AddRenderer(flat_);
  scene_sheet_ = std::make_unique<FlatSheet>(flat_, fonts, window_->GetDPI());
  panel_sheet_ = std::make_unique<FlatSheet>(flat_, fonts, window_->GetDPI());
  before_frame_ = vtkSmartPointer<vtkCallbackCommand>::New();
  before_frame_->SetClientData(this);
  before_frame_->SetCallback([](vtkObject*, unsigned long, void* self, void*) {
    static_cast<DeskWindow*>(self)->DrawFlat();
  });
  window_->AddObserver(vtkCommand::StartEvent, before_frame_);
  Update();
  LookFrom(StandardView::kArray);
  return {};
}

void DeskWindow::Update() {
  std::optional<ValueColors> colors;
  std::string color_by;
  if (const auto& shown = model_->shown()) {
    colors = ValueColors{shown->quantity.key, ValueColorMap(shown->scale)};
    color_by = shown->quantity.key + " " + FormatShortest(shown->scale.low) + " " +
               FormatShortest(shown->scale.high);
  }
  actors_.resize(model_->parts().size());
  for (std::size_t i = 0; i < actors_.size(); ++i) {
    const Part& part = model_->parts()[i];
    const bool visible = model_->IsVisible(part);
    const bool outdated = !part.values.empty() && colored_by_ != color_by;
    if (outdated || (visible && actors_[i].empty())) {
      for (const auto& actor : actors_[i]) scene_->RemoveActor(actor);
      actors_[i] = ActorsOf(part, colors ? &*colors : nullptr, Px(1));
      for (const auto& actor : actors_[i]) scene_->AddActor(actor);
    }
    for (const auto& actor : actors_[i]) actor->SetVisibility(visible);
  }
  colored_by_ = color_by;
}

PixelBox DeskWindow::PanelBox() const {
  const int* size = window_->GetSize();
  const double width = std::min(std::round(Px(kPanelWidth_pt)), 0.5 * size[0]);
  return {size[0] - width, 0, width, double(size[1])};
}

PixelBox DeskWindow::SceneBox() const {
  return {0, 0, PanelBox().left, double(window_->GetSize()[1])};
}

DeskCamera DeskWindow::Camera() const {
  vtkCamera* camera = scene_->GetActiveCamera();
  DeskCamera desk;
  desk.box = SceneBox();
  Eigen::Vector3d position, up;
  camera->GetFocalPoint(desk.camera.focal_in_array_mm.data());
  camera->GetPosition(position.data());
  camera->GetViewUp(up.data());
  desk.camera.towards_viewer = (position - desk.camera.focal_in_array_mm).normalized();
  desk.camera.up =
      (up - up.dot(desk.camera.towards_viewer) * desk.camera.towards_viewer).normalized();
  desk.camera.half_height_mm = camera->GetParallelScale();
  return desk;
}

void DeskWindow::LookFrom(StandardView view) {
  const auto points = model_->PointsToFit(view);
  if (points.empty()) return;
  const ParallelCamera camera =
      FitCamera(points, AxesOf(model_->scene()), DirectionOf(view), SceneBox(), Px(40));
  const Eigen::Vector3d position =
      camera.focal_in_array_mm + 2 * camera.depth_mm * camera.towards_viewer;
  vtkCamera* vtk_camera = scene_->GetActiveCamera();
  vtk_camera->SetFocalPoint(camera.focal_in_array_mm.data());
  vtk_camera->SetPosition(position.data());
  vtk_camera->SetViewUp(camera.up.data());
  vtk_camera->SetParallelScale(camera.half_height_mm);
}

void DeskWindow::Render() { window_->Render(); }

vtkRenderWindow* DeskWindow::window() const { return window_; }

void DeskWindow::Tell(const std::optional<Pick>& pick, bool kept) {
  pick_ = pick;
  kept_ = kept;
}

std::vector<PlacedText> DeskWindow::Texts() const {
  std::vector<PlacedText> texts = panel_sheet_->texts();
  texts.insert(texts.end(), scene_sheet_->texts().begin(), scene_sheet_->texts().end());
  return texts;
}

Result<RgbImage> DeskWindow::Grab() {
  const VtkMessages messages;
  window_->Render();
  const int* size = window_->GetSize();
  RgbImage image{size[0], size[1], window_->GetDPI(), {}};
  auto pixels = vtkSmartPointer<vtkUnsignedCharArray>::New();
  window_->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels, 0);
  if (const std::string problem = messages.FirstError(); !problem.empty())
    return OutputFailed("the window could not be drawn: " + problem);
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(image.width_px);
  const std::size_t bytes = row_bytes * static_cast<std::size_t>(image.height_px);
  if (static_cast<std::size_t>(pixels->GetNumberOfValues()) != bytes)
    return OutputFailed("the window gave no pixels; is there enough memory?");
  image.rgb.resize(bytes);
  for (std::size_t y = 0; y < static_cast<std::size_t>(image.height_px); ++y)
    std::copy_n(pixels->GetPointer(0) + bytes - (y + 1) * row_bytes, row_bytes,
                image.rgb.begin() + static_cast<std::ptrdiff_t>(y * row_bytes));
  return image;
}

}  // namespace telestrain::viz
