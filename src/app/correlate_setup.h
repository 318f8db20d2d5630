#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/correlate_arguments.h"
#include "base/gray_image.h"
#include "correlation/correlation_field.h"
#include "correlation/pattern_assessment.h"

namespace telestrain {

// An image file as it was read.
struct InputImage {
  std::filesystem::path path;
  std::string sha256;
  GrayImage image;
};
Result<InputImage> ReadInput(const std::filesystem::path& path);

// The name of a file for a person; bytes that are no UTF-8 become '?'.
std::string ShownName(const std::filesystem::path& path);

// Whether every image exists, begins like one, is whole and has the reference's size, so that a
// long run does not end at its last image. Reads one file at a time. Fails with kBadInput.
Status CheckImages(const std::vector<std::string>& images, const GrayImage& reference);

// What the arguments come to on this reference.
struct CorrelateSetup {
  FieldOptions options;                      // subset and step are set
  std::vector<Eigen::Vector2i> centers_px;   // of the grid; with a mask only those inside
  std::optional<PatternAssessment> pattern;  // none: the image is too small for one
  std::optional<InputImage> mask;
};

// Reads the region, assesses the pattern, chooses subset and step where they are not given. Fails
// with kUsage when region or subset do not go with the image, with kBadInput when the mask is bad
// or the pattern cannot be assessed though subset or step depend on it.
Result<CorrelateSetup> SetUp(const CorrelateArguments& arguments, const GrayImage& reference);

}  // namespace telestrain
