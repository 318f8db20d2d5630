#pragma once

#include "viz/field_picture.h"
#include "viz/image_backdrop.h"
#include "viz/scene/color_map.h"

namespace telestrain::viz {

inline constexpr Rgb kFieldEdge{0.93, 0.35, 0.05};  // of the region

// The backdrop with the field's values as colours, the region's edge `edge_px` wide and the rest
// faded. Between four neighbours with values, colours follow the bilinear interpolation; elsewhere
// a value covers the half step around its point.
RgbImage ColoredBackdrop(const ImageBackdrop& backdrop, const FieldScene& scene,
                         const ColorMap& colors, int edge_px);

}  // namespace telestrain::viz
