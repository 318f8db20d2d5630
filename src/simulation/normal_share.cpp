#include "simulation/normal_share.h"

#include <cmath>
#include <numbers>

namespace telestrain {

NormalTable::NormalTable() {
  const auto share = [](double x) { return 0.5 * std::erfc(-x * std::numbers::sqrt2 / 2); };
  const auto slope = [](double x) {
    return std::exp(-0.5 * x * x) / std::sqrt(2 * std::numbers::pi) / kPerSigma;
  };
  for (std::size_t i = 0; i < cubics_.size(); ++i) {
    const double left = static_cast<double>(i) / kPerSigma - kEnd, right = left + 1.0 / kPerSigma;
    const double rise = share(right) - share(left);  // Hermite: value and slope at both ends
    cubics_[i] = {share(left), slope(left), 3 * rise - 2 * slope(left) - slope(right),
                  slope(left) + slope(right) - 2 * rise};
  }
}

const NormalTable kNormalTable;

}  // namespace telestrain
