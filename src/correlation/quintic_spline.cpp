#include "correlation/quintic_spline.h"

#include <algorithm>
#include <vector>

namespace telestrain::correlation {
namespace {

// Poles inside the unit circle of z^4 + 26 z^3 + 66 z^2 + 26 z + 1.
constexpr float kPoles[] = {-0.430575347099973791851434783493f, -0.0430962882032646538075920f};
constexpr float kGain = 120.f;  // of one direction
constexpr int kHorizon = 24;    // |pole|^24 is below a float's resolution

// First value of the causal filter of a mirrored row whose elements are `step` apart.
float CausalStart(const float* row, int count, int step, float pole) {
  float sum = row[0], power = pole;
  for (int k = 1; k <= kHorizon; ++k, power *= pole)
    sum += power * row[MirroredIndex(k, count) * step];
  return sum;
}

void FilterRow(float* row, int count, float pole) {
  row[0] = CausalStart(row, count, 1, pole);
  for (int x = 1; x < count; ++x) row[x] += pole * row[x - 1];
  const float end = pole / (pole * pole - 1);
  row[count - 1] = end * (row[count - 1] + pole * row[count - 2]);
  for (int x = count - 2; x >= 0; --x) row[x] = pole * (row[x + 1] - row[x]);
}

void FilterColumns(GrayImage& image, float pole) {
  const int w = image.width, h = image.height;
  std::vector<float> start(static_cast<std::size_t>(w));
  for (int x = 0; x < w; ++x) start[x] = CausalStart(&image.At(x, 0), h, w, pole);
  std::copy(start.begin(), start.end(), &image.At(0, 0));
  for (int y = 1; y < h; ++y)
    for (int x = 0; x < w; ++x) image.At(x, y) += pole * image.At(x, y - 1);
  const float end = pole / (pole * pole - 1);
  for (int x = 0; x < w; ++x)
    image.At(x, h - 1) = end * (image.At(x, h - 1) + pole * image.At(x, h - 2));
  for (int y = h - 2; y >= 0; --y)
    for (int x = 0; x < w; ++x) image.At(x, y) = pole * (image.At(x, y + 1) - image.At(x, y));
}

}  // namespace

int MirroredIndex(int index, int count) {
  const int period = 2 * (count - 1);
  index = std::abs(index) % period;
  return index < count ? index : period - index;
}

void ToSplineCoefficients(GrayImage& image) {
  for (float pole : kPoles) {
    for (int y = 0; y < image.height; ++y) FilterRow(&image.At(0, y), image.width, pole);
    FilterColumns(image, pole);
  }
  for (float& value : image.pixels) value *= kGain * kGain;
}

}  // namespace telestrain::correlation
