#pragma once

#include <filesystem>
#include <string>

namespace telestrain::visual_test {

// What a made-up results folder holds.
struct FixtureContent {
  bool ruler = true;
  bool pipe = true;
};

// Writes inputs.json, calibration.json, ruler.json, strain.json and pipe_NNN.vtp of a plausible
// run: four views of section 13 of the measurement model (A1 A2 at negative x, B1 B2 at positive x,
// z up to the instrument), 12 poses, 17 rulers, an 8 mm pipe under tension and bending with three
// gauges. Same content, same bytes.
void WriteResults(const std::filesystem::path& folder, const FixtureContent& content = {});

// The fixture's pipe: strain at a point of its surface in the state with the largest load.
inline constexpr double kPipeRadius_mm = 4.0;
inline constexpr double kPipeAxisZ_mm = -3.6;
inline constexpr int kGauges = 3;  // columns gauge_1_microstrain and so on, angles as recorded
inline constexpr double kGaugeAxial_mm[] = {0.0, -12.5, 3.0};
inline constexpr double kGaugeAngle_rad[] = {0.0, 0.5, -2.0};
double PipeStrain_microstrain(double x_mm, double y_mm);

// An empty folder of this name for the running test, under the build tree's test output.
std::filesystem::path FreshFolder(const std::string& name);

}  // namespace telestrain::visual_test
