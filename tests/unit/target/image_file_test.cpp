#include "target/image_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "base/files.h"
#include "target/image_header.h"

namespace telestrain {
namespace {

class ImageFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) /
              ("telestrain_image_" +
               std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path Write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  std::filesystem::path Write(const std::string& name, const cv::Mat& pixels) {
    cv::imwrite((folder_ / name).string(), pixels);
    return folder_ / name;
  }
  static std::string MessageOf(const Result<GrayImage>& result) {
    EXPECT_FALSE(result.ok());
    return result.ok() ? "" : result.error().message;
  }

  std::filesystem::path folder_;
};

template <typename T>
cv::Mat Ramp(int type) {
  cv::Mat pixels(5, 7, type);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 7; ++x) pixels.at<T>(y, x) = static_cast<T>(1000 * y + 10 * x + 3);
  return pixels;
}

TEST_F(ImageFile, ReadsGreyLevelsUnchanged) {
  cv::Mat pixels(5, 7, CV_8U);
  for (int i = 0; i < 35; ++i) pixels.data[i] = static_cast<unsigned char>(7 * i);
  for (const char* name : {"a.png", "a.tif", "a.bmp", "a.pgm"}) {
    const auto image = ReadGrayImage(Write(name, pixels), 7, 5);
    ASSERT_TRUE(image.ok()) << image.error().message;
    EXPECT_EQ(image->width, 7);
    EXPECT_EQ(image->height, 5);
    EXPECT_EQ(image->max_gray, 255);
    for (int i = 0; i < 35; ++i) EXPECT_EQ(image->pixels[static_cast<std::size_t>(i)], 7 * i);
  }
}

TEST_F(ImageFile, ReadsSixteenBits) {
  for (const char* name : {"a.png", "a.tif", "a.pgm"}) {
    const auto image = ReadGrayImage(Write(name, Ramp<std::uint16_t>(CV_16U)));
    ASSERT_TRUE(image.ok()) << image.error().message;
    EXPECT_EQ(image->max_gray, 65535);
    EXPECT_EQ(image->At(6, 4), 4063);
  }
}

TEST_F(ImageFile, TurnsColourIntoGrey) {
  for (const int type : {CV_8UC3, CV_8UC4}) {
    const auto image = ReadGrayImage(Write("c.png", cv::Mat(4, 6, type, cv::Scalar::all(93))));
    ASSERT_TRUE(image.ok()) << image.error().message;
    EXPECT_NEAR(image->At(3, 2), 93, 1e-3);
  }
  const auto red = ReadGrayImage(Write("r.png", cv::Mat(4, 6, CV_8UC3, cv::Scalar(0, 0, 200))));
  EXPECT_NEAR(red->At(0, 0), 0.299 * 200, 1e-3);
}

TEST_F(ImageFile, NamesFoundAndWantedSize) {
  const auto path = Write("a.png", cv::Mat(4, 6, CV_8U, cv::Scalar(1)));
  const std::string message = MessageOf(ReadGrayImage(path, 2592, 1944));
  EXPECT_NE(message.find("a.png"), std::string::npos);
  EXPECT_NE(message.find("6 x 4 px"), std::string::npos);
  EXPECT_NE(message.find("2592 x 1944 px"), std::string::npos);
}

TEST_F(ImageFile, RefusesWhatIsNoImage) {
  EXPECT_NE(MessageOf(ReadGrayImage(folder_ / "missing.png")).find("missing.png"),
            std::string::npos);
  EXPECT_NE(MessageOf(ReadGrayImage(Write("e.png", std::string()))).find("empty"),
            std::string::npos);
  EXPECT_NE(MessageOf(ReadGrayImage(Write("t.png", std::string("hello")))).find("t.png"),
            std::string::npos);
  EXPECT_NE(MessageOf(ReadGrayImage(folder_)).find(folder_.string()), std::string::npos);
  MessageOf(ReadGrayImage(Write("f.tif", cv::Mat(4, 6, CV_32F, cv::Scalar(1)))));
}

TEST_F(ImageFile, RefusesFilesThatBreakOff) {
  cv::Mat pixels(60, 80, CV_8U);
  cv::randu(pixels, 0, 255);
  for (const char* name : {"a.png", "a.tif", "a.bmp", "a.pgm", "a.jpg"}) {
    const auto bytes = ReadFile(Write(name, pixels), kMostResultBytes);
    ASSERT_TRUE(bytes.ok());
    for (const std::size_t kept : {std::size_t{3}, std::size_t{30}, bytes->size() / 2}) {
      const auto image = ReadGrayImage(Write(std::string("cut_") + name, bytes->substr(0, kept)));
      EXPECT_FALSE(image.ok()) << name << " cut to " << kept << " bytes";
    }
  }
}

TEST_F(ImageFile, ANumberOfAHeaderEndsWithWhiteSpace) {
  const std::string pixels(12, '\x40');
  EXPECT_TRUE(ReadGrayImage(Write("comment.pgm", "P5\n4 #6 12\n3\n255\n" + pixels)).ok());
  EXPECT_NE(MessageOf(ReadGrayImage(Write("joined.pgm", "P5\n4#6 12\n3\n255\n" + pixels)))
                .find("does not begin like an image"),
            std::string::npos);
}

TEST_F(ImageFile, RefusesHugeImagesBeforeDecoding) {
  std::string png("\x89PNG\r\n\x1A\n\0\0\0\x0DIHDR\0\1\0\0\0\1\0\0\x08\0\0\0\0", 29);
  EXPECT_NE(MessageOf(ReadGrayImage(Write("h.png", png))).find("65536 x 65536 px"),
            std::string::npos);
  EXPECT_NE(MessageOf(ReadGrayImage(Write("h.pgm", std::string("P5\n# c\n90000 90000\n255\n"))))
                .find("limit of 100 million pixels"),
            std::string::npos);
}

TEST_F(ImageFile, HeaderTellsTheSizeOfEveryFormat) {
  const cv::Mat pixels(60, 80, CV_8U, cv::Scalar(9));
  for (const char* name : {"a.png", "a.tif", "a.bmp", "a.pgm", "a.jpg"}) {
    const auto size = SizeFromHeader(*ReadFile(Write(name, pixels), kMostResultBytes));
    ASSERT_TRUE(size.has_value()) << name;
    EXPECT_EQ(size->width_px, 80) << name;
    EXPECT_EQ(size->height_px, 60) << name;
  }
}

}  // namespace
}  // namespace telestrain
