#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

namespace telestrain {

// Shared by the files that make up the results fixture.

using Json = nlohmann::ordered_json;

inline constexpr int kTargetImages = 24, kRulerImages = 12, kStates = 6, kColumns = 13, kRows = 9;
inline const char* const kViews[] = {"A1", "A2", "B1", "B2"};
// What the gauges show before the load; only their change can be compared with the camera.
inline constexpr double kGaugesAtReference_microstrain = 512;

// Numerical Recipes' 64-bit generator: the same everywhere, unlike std::normal_distribution.
class Noise {
 public:
  double Uniform() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11) * 0x1p-53;
  }
  double Gauss() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += Uniform();
    return sum;
  }

 private:
  std::uint64_t state_ = 20260101;
};

inline std::string Numbered(const std::string& stem, int index) {
  return stem + (index < 10 ? "0" : "") + std::to_string(index) + ".png";
}

// calibration.json; fills `residuals_csv` with the residuals that its histogram counts.
Json MakeCalibration(std::string& residuals_csv);

// mrcal.json of the same session.
Json MakeDiagnosis();

}  // namespace telestrain
