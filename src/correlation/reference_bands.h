#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "correlation/correlation_field.h"

namespace telestrain::correlation {

// The reference of a correlation, whole or in bands of rows that are prepared one after the other,
// so that a large image is never held prepared as a whole. A band reaches beyond its points by the
// subset and the filters and starts at a tile of the noise shares, so that a point does not notice
// which band it was in.
class ReferenceBands {
 public:
  explicit ReferenceBands(const CorrelationReference& whole);
  // Keeps pointers to the image and to the mask, if there is one: its pixels do not count.
  ReferenceBands(const GrayImage& image, const FieldOptions& options, const PixelMask* mask);

  const CorrelationOptions& options() const { return options_; }
  // By how many threads the rows of one subset are shared when `points` of them are matched.
  int RowThreads(std::size_t points) const;

  // work(reference, i) for every i of `points`, where the reference holds the subset around
  // centers_px[i]; in parallel, in no particular order.
  using Work = std::function<void(const CorrelationReference&, int)>;
  void ForEach(const std::vector<Eigen::Vector2i>& centers_px, const std::vector<int>& points,
               const Work& work) const;

 private:
  CorrelationReference Prepare(int first_row, int last_row) const;

  CorrelationOptions options_;
  const GrayImage* image_ = nullptr;
  const PixelMask* mask_ = nullptr;
  int band_rows_ = 0;
  std::shared_ptr<const CorrelationReference> whole_;  // when one band is enough
};

}  // namespace telestrain::correlation
