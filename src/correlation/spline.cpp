#include "correlation/spline.h"

#include <cstdlib>

namespace telestrain::correlation {

int MirroredIndex(int index, int count) {
  const int period = 2 * (count - 1);
  index = std::abs(index) % period;
  return index < count ? index : period - index;
}

}  // namespace telestrain::correlation
