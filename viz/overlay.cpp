#include "viz/overlay.h"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>

namespace telestrain::viz {

Overlay::Overlay()
    : points_(vtkSmartPointer<vtkPoints>::New()),
      quads_(vtkSmartPointer<vtkCellArray>::New()),
      colors_(vtkSmartPointer<vtkUnsignedCharArray>::New()),
      data_(vtkSmartPointer<vtkPolyData>::New()),
      actor_(vtkSmartPointer<vtkActor2D>::New()) {
  colors_->SetNumberOfComponents(4);
  data_->SetPoints(points_);
  data_->SetPolys(quads_);
  data_->GetPointData()->SetScalars(colors_);
  auto mapper = vtkSmartPointer<vtkPolyDataMapper2D>::New();
  mapper->SetInputData(data_);
  actor_->SetMapper(mapper);
}

void Overlay::AddQuad(const std::array<Eigen::Vector2d, 4>& corners, const Rgb& color,
                      const std::array<double, 4>& opacities) {
  const auto rgb = BytesOf(color);
  quads_->InsertNextCell(4);
  for (std::size_t i = 0; i < 4; ++i) {
    quads_->InsertCellPoint(points_->InsertNextPoint(corners[i].x(), corners[i].y(), 0));
    const unsigned char rgba[4] = {rgb[0], rgb[1], rgb[2],
                                   static_cast<unsigned char>(std::lround(255 * opacities[i]))};
    colors_->InsertNextTypedTuple(rgba);
  }
  points_->Modified();
  quads_->Modified();
  colors_->Modified();
  data_->Modified();
}

void Overlay::AddBox(const PixelBox& box, const Rgb& fill, double opacity) {
  AddQuad({Eigen::Vector2d(box.left, box.bottom), Eigen::Vector2d(box.Right(), box.bottom),
           Eigen::Vector2d(box.Right(), box.Top()), Eigen::Vector2d(box.left, box.Top())},
          fill, {opacity, opacity, opacity, opacity});
}

void Overlay::AddFrame(const PixelBox& box, const Rgb& color, double width_px) {
  const double w = std::max(1.0, std::round(width_px));
  AddBox({box.left, box.bottom, box.width, w}, color);
  AddBox({box.left, box.Top() - w, box.width, w}, color);
  AddBox({box.left, box.bottom, w, box.height}, color);
  AddBox({box.Right() - w, box.bottom, w, box.height}, color);
}

void Overlay::AddTriangle(const std::array<Eigen::Vector2d, 3>& corners, const Rgb& color) {
  AddQuad({corners[0], corners[1], corners[2], corners[2]}, color, {1, 1, 1, 1});
}

void Overlay::AddLine(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Rgb& color,
                      double width_px) {
  const Eigen::Vector2d along = to - from;
  if (along.norm() < 1e-6) return;
  const Eigen::Vector2d normal = Eigen::Vector2d(-along.y(), along.x()).normalized();
  const Eigen::Vector2d core = std::max(0.0, 0.5 * (width_px - 1)) * normal;
  const Eigen::Vector2d rim = 0.5 * (width_px + 1) * normal;
  AddQuad({from - core, to - core, to + core, from + core}, color, {1, 1, 1, 1});
  AddQuad({from + core, to + core, to + rim, from + rim}, color, {1, 1, 0, 0});
  AddQuad({from - rim, to - rim, to - core, from - core}, color, {0, 0, 1, 1});
}

vtkActor2D* Overlay::Actor() { return actor_; }

}  // namespace telestrain::viz
