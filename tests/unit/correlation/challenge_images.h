#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "base/gray_image.h"

namespace telestrain {

// The images of the DIC Challenge 1.0 (SEM/iDICs). TELESTRAIN_DIC_CHALLENGE names their folder,
// else it is looked for beside the sources.
inline std::filesystem::path ChallengeFolder(const std::string& sample) {
  const char* named = std::getenv("TELESTRAIN_DIC_CHALLENGE");
  const std::filesystem::path beside =
      std::filesystem::path(TELESTRAIN_SOURCE_DIR).parent_path() / "shared/data/dic_challenge";
  return (named ? std::filesystem::path(named) : beside) / sample;
}

inline GrayImage ReadChallengeImage(const std::filesystem::path& file) {
  cv::Mat pixels = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
  EXPECT_FALSE(pixels.empty()) << file;
  GrayImage image{pixels.cols, pixels.rows, 255, {}};
  for (int y = 0; y < pixels.rows; ++y)
    for (int x = 0; x < pixels.cols; ++x) image.pixels.push_back(pixels.at<unsigned char>(y, x));
  return image;
}

inline constexpr char kNoChallengeImages[] =
    "no DIC Challenge images; name their folder by TELESTRAIN_DIC_CHALLENGE";

}  // namespace telestrain
