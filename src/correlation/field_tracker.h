#pragma once

#include <memory>
#include <vector>

#include "base/result.h"
#include "correlation/correlation_field.h"

namespace telestrain {

// Follows one grid of points through a sequence of images. Every image starts from the result
// before it; where nothing is known, from a full search. When the correlation with the reference
// falls below options.update_below_zncc and the image before correlates better, that one takes the
// reference's place (incremental correlation) and the displacements from the first reference are
// composed: a point that comes to lie between the pixels of the new reference is followed by the
// shape function of the subset around the nearest pixel. Covariances add, less what the noise of
// the image that was target first and reference then takes back from itself (point_chain.h).
//
// A point that was lost in the image that becomes the reference is put where its neighbours say,
// with their scatter as its uncertainty, and followed on.
//
// The mask holds for the first reference; on a later one the masked points stay out.
// Holds two images beside the one given (the reference and the image before). Not thread-safe.
class FieldTracker {
 public:
  // Fails (kBadInput) when an option is out of its range, the mask has another size than the image
  // or not one whole subset lies in the region.
  static Result<FieldTracker> Start(GrayImage reference, const FieldOptions& options);

  FieldTracker(FieldTracker&&) noexcept;
  FieldTracker& operator=(FieldTracker&&) noexcept;
  ~FieldTracker();

  // The image must have the size of the reference.
  CorrelationField Track(const GrayImage& image);

  const FieldOptions& options() const;
  // Of the grid, on the first reference, row by row; as GridCenters.
  const std::vector<Eigen::Vector2i>& centers_px() const;

 private:
  class State;
  explicit FieldTracker(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace telestrain
