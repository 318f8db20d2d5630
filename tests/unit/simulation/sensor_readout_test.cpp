#include "simulation/sensor_readout.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulation/gray_png.h"

namespace telestrain {
namespace {

GrayImage Flat(float gray) { return {500, 401, 255, std::vector<float>(500 * 401, gray)}; }

void ExpectNoise(const GrayImage& image, double mean_level, double sd_levels) {
  double sum = 0, squares = 0;
  for (const float level : image.pixels) {
    sum += level - mean_level;
    squares += (level - mean_level) * (level - mean_level);
  }
  const auto n = static_cast<double>(image.pixels.size());
  const double mean = sum / n;
  EXPECT_NEAR(mean, 0, 4 * sd_levels / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n - mean * mean), sd_levels, 4 * sd_levels / std::sqrt(2 * n));
}

TEST(ReadOut, NoiseAndQuantisationAddUpToTheWantedNoise) {
  ExpectNoise(ReadOut(Flat(100.3F), {8, 1.5, 0}, 42), 100.3F, 1.5);
  ExpectNoise(ReadOut(Flat(37.8F), {8, 0.8, 0}, 42), 37.8F, 0.8);
  ExpectNoise(ReadOut(Flat(100.3F), {16, 1.5, 0}, 42), 257 * double(100.3F), 257 * 1.5);
}

TEST(ReadOut, WithoutNoiseRoundsAndClips) {
  EXPECT_EQ(ReadOut(Flat(100.3F), {8, 0, 0}, 1).At(3, 4), 100);
  EXPECT_EQ(ReadOut(Flat(100.5F), {8, 0, 0}, 1).At(3, 4), 101);
  EXPECT_EQ(ReadOut(Flat(300), {8, 0, 0}, 1).At(3, 4), 255);
  EXPECT_EQ(ReadOut(Flat(-5), {8, 0, 0}, 1).At(3, 4), 0);
  EXPECT_EQ(ReadOut(Flat(100), {16, 0, 0}, 1).At(3, 4), 25700);
  EXPECT_EQ(ReadOut(Flat(100), {16, 0, 0}, 1).max_gray, 65535);
}

TEST(ReadOut, HasALinearPhotonTransferCurve) {
  constexpr double kFullWell = 10000, kRead_gray = 1.5;
  double sum_w = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
  for (int level = 10; level <= 230; level += 20) {
    const GrayImage image = ReadOut(Flat(static_cast<float>(level)), {12, kRead_gray, kFullWell},
                                    static_cast<std::uint64_t>(level));
    double sum = 0, squares = 0;
    for (const float stored : image.pixels) {
      const double gray = static_cast<double>(stored) / 16 * 255 / 4095 - level;
      sum += gray;
      squares += gray * gray;
    }
    const auto n = static_cast<double>(image.pixels.size());
    const double variance = squares / n - sum * sum / n / n;
    const double expected = kRead_gray * kRead_gray + level * 255 / kFullWell;
    const double sigma = expected * std::sqrt(2 / n);  // of a sample variance
    EXPECT_NEAR(variance, expected, 4 * sigma) << level;
    const double w = 1 / (sigma * sigma);
    sum_w += w;
    sum_x += w * level;
    sum_y += w * variance;
    sum_xx += w * level * level;
    sum_xy += w * level * variance;
  }
  const double spread = sum_w * sum_xx - sum_x * sum_x;
  const double slope = (sum_w * sum_xy - sum_x * sum_y) / spread;
  EXPECT_NEAR(slope, 255 / kFullWell, 4 * std::sqrt(sum_w / spread));
}

TEST(ReadOut, StoresTenAndTwelveBitsShiftedUp) {
  for (const int bits : {10, 12}) {
    const int unit = 1 << (16 - bits), top = (1 << bits) - 1;
    EXPECT_EQ(ReadOut(Flat(100), {bits, 0, 0}, 1).At(3, 4),
              unit * std::floor(100.0 / 255 * top + 0.5));
    EXPECT_EQ(ReadOut(Flat(300), {bits, 0, 0}, 1).At(3, 4), unit * top);
    EXPECT_EQ(ReadOut(Flat(1), {bits, 0, 0}, 1).max_gray, 65535);
    for (const float level : ReadOut(Flat(77), {bits, 1.0, 0}, 5).pixels)
      ASSERT_EQ(std::fmod(level, static_cast<float>(unit)), 0);
  }
}

TEST(EncodePng, FailsOnNothingAndKeepsTheDepth) {
  const std::string eight = EncodePng(ReadOut(Flat(9), {8, 0, 0}, 1)).value();
  const std::string twelve = EncodePng(ReadOut(Flat(9), {12, 0, 0}, 1)).value();
  EXPECT_EQ(eight[24], 8);  // in the IHDR chunk
  EXPECT_EQ(twelve[24], 16);
}

TEST(ReadOut, NoiseDoesNotDependOnThreads) {
  GrayImage ideal{521, 403, 255, std::vector<float>(521 * 403, 90.0F)};  // over several blocks
  const SensorModel sensor{8, 2, 5000};
  EXPECT_EQ(ReadOut(ideal, sensor, 7, 1).pixels, ReadOut(ideal, sensor, 7, 3).pixels);
}

}  // namespace
}  // namespace telestrain
