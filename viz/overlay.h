#pragma once

#include <vtkSmartPointer.h>

#include <Eigen/Core>
#include <array>

#include "viz/scene/camera.h"
#include "viz/scene/color_map.h"

class vtkActor2D;
class vtkCellArray;
class vtkPoints;
class vtkPolyData;
class vtkUnsignedCharArray;

namespace telestrain::viz {

// Flat shapes on top of everything, in px from the picture's lower left corner, drawn in the order
// in which they are added.
class Overlay {
 public:
  Overlay();

  void AddBox(const PixelBox& box, const Rgb& fill, double opacity = 1);
  void AddFrame(const PixelBox& box, const Rgb& color, double width_px);
  void AddTriangle(const std::array<Eigen::Vector2d, 3>& corners, const Rgb& color);
  // A straight stroke with soft edges.
  void AddLine(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Rgb& color,
               double width_px);
  vtkActor2D* Actor();

 private:
  void AddQuad(const std::array<Eigen::Vector2d, 4>& corners, const Rgb& color,
               const std::array<double, 4>& opacities);

  vtkSmartPointer<vtkPoints> points_;
  vtkSmartPointer<vtkCellArray> quads_;
  vtkSmartPointer<vtkUnsignedCharArray> colors_;
  vtkSmartPointer<vtkPolyData> data_;
  vtkSmartPointer<vtkActor2D> actor_;
};

}  // namespace telestrain::viz
