#include "target/image_structure.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

namespace telestrain {
namespace {

std::string Encoded(const std::string& extension) {
  cv::Mat pixels(30, 40, CV_8U);
  cv::randu(pixels, 0, 255);
  std::vector<unsigned char> bytes;
  cv::imencode(extension, pixels, bytes);
  return {bytes.begin(), bytes.end()};
}

TEST(ImageStructure, WholeFilesHaveNoFault) {
  for (const std::string extension : {".png", ".jpg", ".tif", ".bmp", ".pgm"})
    EXPECT_EQ(StructureFault(Encoded(extension)), "") << extension;
}

TEST(ImageStructure, WhatFollowsTheImageIsNoFault) {
  for (const std::string extension : {".png", ".jpg", ".bmp", ".pgm"})
    EXPECT_EQ(StructureFault(Encoded(extension) + "appended"), "") << extension;
}

TEST(ImageStructure, FilesThatBreakOffAreToldByTheByte) {
  for (const std::string extension : {".png", ".jpg"}) {
    const std::string bytes = Encoded(extension);
    for (std::size_t kept = 40; kept < bytes.size(); kept += 7) {
      const std::string fault = StructureFault(bytes.substr(0, kept));
      // A JPEG says its size after its tables; before that there is no header to break off.
      EXPECT_TRUE(fault.find("byte ") != std::string::npos ||
                  (extension == ".jpg" && fault == "has no header that is known"))
          << extension << kept << fault;
    }
  }
}

// A camera's preview has an end of its own, which must not pass for that of the image.
TEST(ImageStructure, TheEndOfAPreviewIsNotTheEndOfTheImage) {
  const std::string image = Encoded(".jpg"), preview = Encoded(".jpg");
  const std::size_t size = preview.size() + 2;
  const std::string segment = std::string("\xFF\xE1") + static_cast<char>(size >> 8) +
                              static_cast<char>(size & 255) + preview;
  const std::string whole = image.substr(0, 2) + segment + image.substr(2);
  EXPECT_EQ(StructureFault(whole), "");
  EXPECT_NE(StructureFault(whole.substr(0, whole.size() - 100)), "");
}

}  // namespace
}  // namespace telestrain
