#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/gray_image.h"
#include "simulation/virtual_instrument.h"

namespace telestrain {

// Weights of four equidistant nodes at -1, 0, 1, 2 for the cubic through them at t.
Eigen::Vector4d CubicWeights(double t);

// Ideal image-plane coordinates (mm) of the pixels (first_x + i, y), i < count: the inverse of the
// lens's distortion, exact at every 16th pixel and cubic between them (error below 1e-9 mm up to
// 2 % distortion).
std::vector<Eigen::Vector2d> IdealOfRow(const TelecentricLens& lens, int first_x, int y, int count);

// Grey levels (8-bit scale, in even light) that one row of one view has at these ideal coordinates.
using RowShader =
    std::function<void(const InstrumentView& view, const std::vector<Eigen::Vector2d>& ideal_mm,
                       std::span<float> gray)>;

// The noise-free image of a scene in the instrument's light, behind its dust; rows in parallel.
// `max_gray` is 255, levels above it are kept.
GrayImage RenderScene(const VirtualInstrument& instrument, const RowShader& shader, int threads);

}  // namespace telestrain
