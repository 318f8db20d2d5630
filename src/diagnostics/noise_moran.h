#pragma once

#include <utility>
#include <vector>

namespace telestrain {

// Moran's I of values at places of which some pairs are neighbours, each pair once. Without
// neighbours or spread z is 0 and p 1.
struct MoranStatistic {
  double i = 0, expected = 0, z = 0;
  double p_value = 1;  // of more likeness
};
MoranStatistic MoransI(const std::vector<double>& values,
                       const std::vector<std::pair<int, int>>& neighbours);

}  // namespace telestrain
