#pragma once

#include <vtkSmartPointer.h>

#include <vector>

#include "viz/scene/part.h"

class vtkActor;
class vtkLookupTable;
class vtkPolyData;
class vtkRenderer;

namespace telestrain::viz {

// The parts of a scene as VTK data and actors, without a window: for every program that draws.

// Which of the values colours a part, and how. A part without this quantity keeps its own colour.
struct ValueColors {
  std::string quantity;  // Quantity::key
  ColorMap colors;
};

// Points, polygons and lines; every quantity as point data with its key as name.
vtkSmartPointer<vtkPolyData> DataOf(const Part& part);
vtkSmartPointer<vtkLookupTable> TableOf(const ColorMap& colors);

// Ready to be added: one for the faces, one for the lines, where the part has them. `colors` may be
// null; `point_px` is the size of 1/72 inch in px, for line widths.
std::vector<vtkSmartPointer<vtkActor>> ActorsOf(const Part& part, const ValueColors* colors,
                                                double point_px);

// Few actors for many parts: those without the quantity that look alike share one.
void AddParts(vtkRenderer* renderer, const std::vector<Part>& parts, const ValueColors* colors,
              double point_px);

}  // namespace telestrain::viz
