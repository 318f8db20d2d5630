#pragma once

#include <vector>

#include "correlation/subset_correlation.h"

namespace telestrain {

// How the content of one view moved since the reference, on the whole: the pixel p of the reference
// is found at p + shift_px + gradient (p - middle of the view's region).
struct ViewMotion {
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();
  Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();

  Eigen::Vector2d At(const Eigen::Vector2d& from_middle_px) const {
    return shift_px + gradient * from_middle_px;
  }
  bool operator==(const ViewMotion&) const = default;
};

// A view of one state beside the same view of the reference.
struct ViewPair {
  const CorrelationReference& reference;
  const PreparedImage& image;
  const GrayImage& reference_image;  // of the whole sensor, as the next one
  const GrayImage& state_image;
};

struct FoundMotion {
  ViewMotion motion;
  bool by_search = false;  // the prediction failed
  bool sure = false;       // enough of the seeds agree with it
};

// The motion of a view from some of its points: tried from the predicted one and, when that fails,
// from an exhaustive search for the shift, first near and then far. Where nothing agrees, the
// prediction comes back, not sure. Thread-safe.
FoundMotion FindMotion(const ViewPair& views, const std::vector<Eigen::Vector2i>& centers_px,
                       const ViewMotion& predicted);

// The motion through matches of a view's points, by least squares over those within 2 px of
// `near`. `near` itself when there are too few.
ViewMotion FitMotion(const PixelRegion& region, const std::vector<Eigen::Vector2i>& centers_px,
                     const std::vector<SubsetMatch>& matches, const ViewMotion& near);

// What every point starts from when its view moved like that.
std::vector<ShapeFunction> StartsOf(const PixelRegion& region,
                                    const std::vector<Eigen::Vector2i>& centers_px,
                                    const ViewMotion& motion);

}  // namespace telestrain
