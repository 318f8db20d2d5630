#include "diagnostics/noise_moran.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "diagnostics/noise_distributions.h"

namespace telestrain {
namespace {

// Mean, standard deviation and skewness of Moran's I of independent normal values.
struct MoranMoments {
  double mean = 0, sd = 0, skewness = 0;
};

// W is symmetric with ones for neighbours, M takes the mean out. I = N / S0 z'Wz / z'z, and as the
// ratio is independent of z'z its moments are ratios of moments; those of z'Wz follow from the
// traces of the powers of MW.
MoranMoments MomentsUnderNormality(std::size_t places,
                                   const std::vector<std::pair<int, int>>& neighbours) {
  const auto n = static_cast<double>(places), pairs = static_cast<double>(neighbours.size());
  std::vector<std::vector<int>> of_place(places);
  for (const auto& [a, b] : neighbours) {
    of_place[static_cast<std::size_t>(a)].push_back(b);
    of_place[static_cast<std::size_t>(b)].push_back(a);
  }
  for (auto& list : of_place) std::sort(list.begin(), list.end());
  double w2 = 0, w3 = 0, shared = 0;  // 1'WW1, 1'WWW1, common neighbours over all pairs
  for (const auto& list : of_place) w2 += static_cast<double>(list.size() * list.size());
  std::vector<int> both;
  for (const auto& [a, b] : neighbours) {
    const auto &x = of_place[static_cast<std::size_t>(a)],
               &y = of_place[static_cast<std::size_t>(b)];
    w3 += 2.0 * static_cast<double>(x.size() * y.size());
    both.clear();
    std::set_intersection(x.begin(), x.end(), y.begin(), y.end(), std::back_inserter(both));
    shared += static_cast<double>(both.size());
  }
  const double s = 2 * pairs;  // 1'W1
  const double t1 = -s / n, t2 = 2 * pairs - 2 * w2 / n + s * s / (n * n);
  const double t3 = 2 * shared - 3 * w3 / n + 3 * s * w2 / (n * n) - s * s * s / (n * n * n);
  const double m = n - 1, factor = n / s;
  const double first = factor * t1 / m;
  const double second = factor * factor * (t1 * t1 + 2 * t2) / (m * (m + 2));
  const double third =
      factor * factor * factor * (t1 * t1 * t1 + 6 * t1 * t2 + 8 * t3) / (m * (m + 2) * (m + 4));
  const double variance = second - first * first;
  if (!(variance > 0)) return {first};
  const double sd = std::sqrt(variance);
  return {first, sd, (third - 3 * first * second + 2 * first * first * first) / (variance * sd)};
}

// P(Z > z) of a standardised variable with this skewness: Pearson's type III, a shifted gamma
// distribution; normal where there is none to speak of, or to the left.
double PearsonUpperTail(double z, double skewness) {
  if (skewness < 1e-3) return NormalUpperTail(z);
  const double degrees = 8 / (skewness * skewness);
  return ChiSquareUpperTail(degrees + z * std::sqrt(2 * degrees), degrees);
}

}  // namespace

MoranStatistic MoransI(const std::vector<double>& values,
                       const std::vector<std::pair<int, int>>& neighbours) {
  MoranStatistic moran;
  const auto n = static_cast<double>(values.size()), pairs = static_cast<double>(neighbours.size());
  if (n < 4 || pairs == 0) return moran;
  double mean = 0, squares = 0, products = 0;
  for (const double value : values) mean += value / n;
  for (const double value : values) squares += (value - mean) * (value - mean);
  if (!(squares > 0)) return moran;
  for (const auto& [a, b] : neighbours)
    products +=
        (values[static_cast<std::size_t>(a)] - mean) * (values[static_cast<std::size_t>(b)] - mean);
  moran.i = n / pairs * products / squares;
  const MoranMoments moments = MomentsUnderNormality(values.size(), neighbours);
  moran.expected = moments.mean;
  if (!(moments.sd > 0)) return moran;
  moran.z = (moran.i - moments.mean) / moments.sd;
  moran.p_value = PearsonUpperTail(moran.z, moments.skewness);
  return moran;
}

}  // namespace telestrain
