#pragma once

#include <cstddef>
#include <vector>

#include "calibration/calibration_data.h"

// Private to the calibration module.
namespace telestrain {

// The corners of a board, an array for each quantity, padded with corners of weight zero.
class CornerArrays {
 public:
  explicit CornerArrays(const BoardData& board);
  int Padded() const { return padded_; }
  enum Quantity { kX, kY, kCurveX, kCurveY, kU, kV, kW00, kW01, kW10, kW11, kQuantities };
  const double* operator[](Quantity quantity) const {
    return values_.data() + static_cast<std::ptrdiff_t>(quantity) * padded_;
  }

 private:
  int padded_;
  std::vector<double> values_;
};

}  // namespace telestrain
