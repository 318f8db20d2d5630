#include "tests/unit/session/sample_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

namespace telestrain {
namespace {

// The example of the format's description, with every optional key and two views.
constexpr char kSessionToml[] = R"(schema = "telestrain.session/1"
title = "Sample"

[sensor]
width_px = 2592
height_px = 1944
pixel_pitch_um = 2.2

[lens]
magnification = 0.5
depth_of_field_mm = 3.1

[[view]]
name = "A1"
group = "A"
region_px = [0, 0, 1296, 972]
image_x_in_array = [-1.0, 0.0, 0.0]
image_y_in_array = [0.0, 0.866, -0.5]
axis_in_array    = [0.0, 0.5, 0.866]
center_in_array_mm = [-13.85, 0.0, 0.0]

[[view]]
name = "B1"
group = "B"
region_px = [1296, 0, 1296, 972]
image_x_in_array = [1, 0, 0]
image_y_in_array = [0.0, 0.866, 0.5]
axis_in_array    = [0.0, -0.5, 0.866]
center_in_array_mm = [13.85, 0, 0]

[stage]
axis_in_array = [0.0, 0.0, -1.0]
sigma_mm = 0.004

[target]
columns = 13
rows = 9
square_mm = 0.3
sigma_square_um = 0.25
sigma_separation_um = 0.3
coplanarity_um = 1
flatness_um = 0.4
[[target.board]]
group = "A"
center_in_target_mm = [-13.85, 0.0, 0.0]
[[target.board]]
group = "B"
center_in_target_mm = [13.85, 0.0, 0.0]
rotation_deg = 0.7

[ruler]
length_mm = 27.6
sigma_length_um = 0.25

[pipe]
outer_diameter_mm = 8.0
poisson_ratio = 0.31
material = "copper"

[acceptance]
reprojection_rms_px = 1.0
ruler_mpe_um = 10
strain_error_microstrain = 20.0
coverage_factor = 2.5
decision_rule = "simple"

[document]
report_number = "R-17"
revision = 3
checked = true
temperature_degC = 20.5
date = 2024-05-17
)";

constexpr char kCalibrationCsv[] =
    "image,pose,stage_mm\n"
    "images/c0.png,p0,0\n"
    "images/c1.png,p0,0.25\n";

constexpr char kPipeCsv[] =
    "image,cycle,step,time_s,gauge_1_microstrain,gauge_back_microstrain\n"
    "images/p0.png,1,0,0,0,0.5\n"
    "images/p1.png,1,1,12.5,,101.25\n";

}  // namespace

SampleFolder::SampleFolder(const std::string& name)
    : path_(std::filesystem::path(testing::TempDir()) /
            ("session_" + name + std::to_string(::getpid()))) {
  std::filesystem::remove_all(path_);
  Write("session.toml", kSessionToml);
  Write("calibration.csv", kCalibrationCsv);
  Write("ruler.csv", "image\nimages/r0.png\n");
  Write("pipe.csv", kPipeCsv);
  for (const char* image : {"c0", "c1", "r0", "p0", "p1"})
    Write(std::string("images/") + image + ".png", "not decoded");
}

SampleFolder::~SampleFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void SampleFolder::Write(const std::string& file, const std::string& text) const {
  std::filesystem::create_directories((path_ / file).parent_path());
  std::ofstream(path_ / file, std::ios::binary) << text;
}

std::string SampleFolder::Read(const std::string& file) const {
  std::ifstream stream(path_ / file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void SampleFolder::Remove(const std::string& file) const {
  std::filesystem::remove_all(path_ / file);
}

void SampleFolder::Replace(const std::string& file, const std::string& from,
                           const std::string& to) const {
  std::string text = Read(file);
  const auto at = text.find(from);
  if (at == std::string::npos || text.find(from, at + 1) != std::string::npos)
    throw std::logic_error(file + " does not hold exactly once: " + from);
  Write(file, text.replace(at, from.size(), to));
}

int SampleFolder::LineOf(const std::string& file, const std::string& text) const {
  const std::string content = Read(file);
  const auto at = content.find(text);
  if (at == std::string::npos) throw std::logic_error(file + " does not hold: " + text);
  const auto begin = content.begin();
  return 1 + static_cast<int>(std::count(begin, begin + static_cast<std::ptrdiff_t>(at), '\n'));
}

}  // namespace telestrain
