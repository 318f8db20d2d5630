// Sample 14 of the DIC Challenge 1.0 (SEM/iDICs): u is a wave of 0.1 px along x whose period falls
// from left to right; the higher L, the shorter the periods.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

#include "tests/unit/correlation/challenge_images.h"
#include "tests/unit/correlation/speckle.h"

namespace telestrain {
namespace {

constexpr int kLevels[] = {1, 3, 5};

// True displacement of L1, L3 and L5 by column.
std::vector<std::array<double, 3>> ReadTruth(const std::filesystem::path& file) {
  std::vector<std::array<double, 3>> truth;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::array<double, 7> row{};
    std::string cell;
    for (double& value : row)
      if (std::getline(cells, cell, ',')) value = std::stod(cell);
    EXPECT_EQ(row[0], static_cast<double>(truth.size()));
    truth.push_back({row[1], row[3], row[5]});
  }
  return truth;
}

class Sample14 : public testing::Test {
 protected:
  // Regression of the measured displacement, the mean of every column, on the true one.
  double AmplitudeRatio(int level, int order) const {
    const CorrelationOptions options{.subset_px = 33, .shape_order = order};
    const GrayImage before = ReadChallengeImage(folder_ / "Sample14 Reference.tif");
    const PixelRegion region{0, 0, before.width, before.height};
    const CorrelationReference reference(before, region, options);
    const std::string name = "Sample14 L" + std::to_string(kLevels[level]) + " Amp0.1b.tif";
    const PreparedImage image(ReadChallengeImage(folder_ / name), region, options);
    const auto centers = GridOfCenters(region, 25, 10);
    const auto matches = CorrelatePoints(reference, centers, image, {ShapeFunction()});
    std::map<int, std::pair<double, int>> columns;
    for (std::size_t i = 0; i < centers.size(); ++i) {
      EXPECT_TRUE(matches[i].ok()) << centers[i].transpose();
      auto& [sum, count] = columns[centers[i].x()];
      sum += matches[i].shape.displacement_px.x();
      ++count;
    }
    const auto truth = ReadTruth(folder_ / "command.csv");
    double products = 0, squares = 0;
    for (const auto& [x, column] : columns) {
      const double expected = truth.at(x)[level];
      products += column.first / column.second * expected;
      squares += expected * expected;
    }
    std::printf("L%d order %d: %.4f\n", kLevels[level], order, products / squares);
    return products / squares;
  }

  const std::filesystem::path folder_ = ChallengeFolder("challenge1_sample14");
};

// Order 2, which follows the curvature of the wave within the subset.
TEST_F(Sample14, AmplitudesAreKept) {
  if (!std::filesystem::exists(folder_)) GTEST_SKIP() << kNoChallengeImages;
  EXPECT_NEAR(AmplitudeRatio(0, 2), 1, 0.005);
  EXPECT_GE(AmplitudeRatio(1, 2), 0.985);
  EXPECT_GE(AmplitudeRatio(2, 2), 0.94);
}

}  // namespace
}  // namespace telestrain
