#include "report/calibration_changes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace telestrain {
namespace {

constexpr double kScale_px_per_mm = 227;

using Vector = std::array<double, 3>;

// A view that looks down at `tilt_rad` about x, its field centred at x = `at_mm`; the whole array
// turned by `turn_rad` about z and shifted by `shift_mm` along x.
Json View(const std::string& name, double tilt_rad, double at_mm, double turn_rad,
          double shift_mm) {
  const double c = std::cos(turn_rad), s = std::sin(turn_rad);
  const auto turned = [&](Vector v) {
    return Vector{c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]};
  };
  const Vector x = turned({1, 0, 0}), y = turned({0, std::cos(tilt_rad), std::sin(tilt_rad)}),
               axis = turned({0, std::sin(tilt_rad), -std::cos(tilt_rad)});
  Vector middle = turned({at_mm, 0, 0});
  middle[0] += shift_mm;
  const auto dot = [&](const Vector& a) {
    return a[0] * middle[0] + a[1] * middle[1] + a[2] * middle[2];
  };
  return {{"name", name},
          {"image_x_in_array", x},
          {"image_y_in_array", y},
          {"axis_in_array", axis},
          {"offset_px", {600 - kScale_px_per_mm * dot(x), 480 - kScale_px_per_mm * dot(y)}},
          {"center_in_array_mm", middle}};
}

Json Calibration(double turn_rad, double shift_mm) {
  Json json = {
      {"lens",
       {{"magnification_px_per_mm", kScale_px_per_mm}, {"sigma_magnification_px_per_mm", 0.003}}},
      {"views", Json::array()}};
  json["views"].push_back(View("A1", 0.5, -14, turn_rad, shift_mm));
  json["views"].push_back(View("A2", -0.5, -14, turn_rad, shift_mm));
  json["views"].push_back(View("B1", 0.5, 14, turn_rad, shift_mm));
  json["views"].push_back(View("B2", -0.5, 14, turn_rad, shift_mm));
  return json;
}

double ValueOf(const std::vector<CalibrationChange>& changes, const std::string& quantity) {
  for (const CalibrationChange& change : changes)
    if (TextAt(Json{{"q", change.quantity}}, "/q") == quantity) return change.value;
  ADD_FAILURE() << "no change of " << quantity;
  return NAN;
}

// Two calibrations of one instrument have array frames of their own: the frame is no change.
TEST(CalibrationChanges, AnotherFrameIsNoChange) {
  const auto changes = ChangesOfCalibrations(Calibration(0, 0), Calibration(0.01, 0.4));
  ASSERT_EQ(changes.size(), 13u);  // the magnification, and three of each view
  for (const CalibrationChange& change : changes)
    EXPECT_NEAR(change.value, 0, 1e-6) << change.quantity.dump();  // rounding of 1e-16 · 14 mm
}

// A view turned by 100 urad about its own u axis: the best common turn takes a quarter of it along
// (the four views weigh alike), so that 75 urad are left on it and 25 urad on the others.
TEST(CalibrationChanges, ATurnedViewShows) {
  Json after = Calibration(0.01, 0.4);
  after["views"][0] = View("A1", 0.5 + 1e-4, -14, 0.01, 0.4);
  const auto changes = ChangesOfCalibrations(Calibration(0, 0), after);
  EXPECT_NEAR(ValueOf(changes, "direction of A1"), 75, 0.01);
  EXPECT_NEAR(ValueOf(changes, "direction of B2"), 25, 0.01);
}

// A field that moved by 4 um along u moves the common shift by a quarter of it.
TEST(CalibrationChanges, AShiftedFieldShows) {
  Json after = Calibration(0, 0);
  after["views"][0]["offset_px"][0] =
      after["views"][0]["offset_px"][0].get<double>() + 0.004 * kScale_px_per_mm;
  const auto changes = ChangesOfCalibrations(Calibration(0, 0), after);
  EXPECT_NEAR(ValueOf(changes, "shift of the field of A1 along u"), 3, 1e-6);
  EXPECT_NEAR(ValueOf(changes, "shift of the field of B1 along u"), -1, 1e-6);
  EXPECT_NEAR(ValueOf(changes, "shift of the field of A1 along v"), 0, 1e-6);
}

TEST(CalibrationChanges, TheMagnificationHasItsUncertainty) {
  Json after = Calibration(0, 0);
  after["lens"]["magnification_px_per_mm"] = kScale_px_per_mm + 0.01;
  after["lens"]["sigma_magnification_px_per_mm"] = 0.004;
  const auto changes = ChangesOfCalibrations(Calibration(0, 0), after);
  EXPECT_NEAR(changes[0].value, 0.01, 1e-12);
  EXPECT_NEAR(*changes[0].standard_uncertainty, 0.005, 1e-12);  // 3, 4, 5
}

TEST(CalibrationChanges, MissingPartsAreLeftOut) {
  EXPECT_TRUE(ChangesOfCalibrations(Json(), Calibration(0, 0)).empty());
  Json after = Calibration(0, 0);
  after["views"][1].erase("offset_px");
  EXPECT_EQ(ChangesOfCalibrations(Calibration(0, 0), after).size(), 10u);
  EXPECT_TRUE(ChangesOfComparison(Json()).empty());
}

}  // namespace
}  // namespace telestrain
