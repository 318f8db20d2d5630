#include "report/rgb_image.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "pdf_tools.h"
#include "results_fixture.h"

namespace telestrain {
namespace {

// Undoes the PNG filters (PNG specification, 9.2), written independently of the product's code.
std::vector<unsigned char> Unfilter(const std::string& rows, int width, int height) {
  const int bytes = 3 * width;
  std::vector<unsigned char> out(static_cast<std::size_t>(bytes) * height);
  const auto at = [&](int y, int i) {
    return y < 0 || i < 0 ? 0 : static_cast<int>(out[static_cast<std::size_t>(y) * bytes + i]);
  };
  for (int y = 0; y < height; ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * (bytes + 1);
    for (int i = 0; i < bytes; ++i) {
      const int a = at(y, i - 3), b = at(y - 1, i), c = i < 3 ? 0 : at(y - 1, i - 3);
      const int p = a + b - c;
      const int pa = std::abs(p - a), pb = std::abs(p - b), pc = std::abs(p - c);
      const int guess[] = {0, a, b, (a + b) / 2, pa <= pb && pa <= pc ? a : pb <= pc ? b : c};
      const int value = static_cast<unsigned char>(rows[row + 1 + i]) + guess[int(rows[row])];
      out[static_cast<std::size_t>(y) * bytes + i] = static_cast<unsigned char>(value);
    }
  }
  return out;
}

TEST(RgbImage, PredictedRowsGiveThePixelsBack) {
  const auto path = TestFolder("rgb") / "picture.png";
  WritePicture(path, 61, 37);
  const auto image = ReadPng(path);
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->width_px, 61);
  EXPECT_EQ(image->height_px, 37);
  EXPECT_EQ(Unfilter(PredictRows(*image), 61, 37), image->pixels);
}

TEST(RgbImage, ADamagedFileIsBadInputWithItsName) {
  const auto path = TestFolder("rgb") / "damaged.png";
  WritePicture(path, 300, 200);
  const std::string whole = FileBytes(path.string());
  for (const std::size_t size : {std::size_t{0}, std::size_t{20}, whole.size() / 2}) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << whole.substr(0, size);
    const auto image = ReadPng(path);
    ASSERT_FALSE(image) << size;
    EXPECT_EQ(image.error().kind, ErrorKind::kBadInput);
    EXPECT_NE(image.error().message.find("damaged.png"), std::string::npos);
    if (size > 0) {  // an empty file is a matter of the file reader
      EXPECT_NE(image.error().message.find("'telestrain render'"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace telestrain
