#pragma once

#include "viz/pictures.h"

class vtkImageData;

namespace telestrain::viz {

// The picture as VTK holds it: three unsigned bytes a pixel, the bottom row first.
void FillImageData(const RgbImage& image, vtkImageData* data);

}  // namespace telestrain::viz
