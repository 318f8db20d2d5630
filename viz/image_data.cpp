#include "viz/image_data.h"

#include <vtkImageData.h>

#include <cstring>

namespace telestrain::viz {

void FillImageData(const RgbImage& image, vtkImageData* data) {
  data->SetDimensions(image.width_px, image.height_px, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(image.width_px);
  for (int y = 0; y < image.height_px; ++y)
    std::memcpy(data->GetScalarPointer(0, image.height_px - 1 - y, 0),
                image.rgb.data() + static_cast<std::size_t>(y) * row_bytes, row_bytes);
}

}  // namespace telestrain::viz
