#include "calibration/calibration_record.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/json_file.h"
#include "calibration/calibration_file.h"
#include "tests/unit/base/scratch_folder.h"
#include "unit/calibration/synthetic_array.h"

namespace telestrain {
namespace {

using testing_support::MakeSyntheticArray;
using testing_support::MustCalibrate;
using testing_support::SyntheticArray;

void Save(const SyntheticArray& array, const Calibration& calibration,
          const ScratchFolder& folder) {
  ASSERT_TRUE(
      WriteJson(folder.path() / "calibration.json", CalibrationJson(array.session, calibration, {}))
          .ok());
  std::ofstream(folder.path() / "residuals.csv") << ResidualsCsv(array.session, calibration);
}

TEST(CalibrationRecord, HoldsTheMinimumThatWasFound) {
  testing_support::SyntheticOptions options;
  options.k1_per_mm2 = 2e-5;
  options.poses = 6;
  const SyntheticArray array = MakeSyntheticArray(options);
  const Calibration calibration = MustCalibrate(array);
  const ScratchFolder folder("calibration_record");
  Save(array, calibration, folder);
  const auto record = ReadCalibrationRecord(array.session, folder.path());
  ASSERT_TRUE(record.ok()) << record.error().message;
  ASSERT_EQ(record->data.boards.size(), calibration.data.boards.size());
  for (std::size_t b = 0; b < record->data.boards.size(); ++b) {
    const BoardData &read = record->data.boards[b], &own = calibration.data.boards[b];
    // Numbers read back to the same value; only products round.
    EXPECT_LT((ReprojectionErrors_px(record->state, read) -
               ReprojectionErrors_px(calibration.bundle.state, own))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-9);
    EXPECT_LT((read.whitening[0] - own.whitening[0]).norm(), 1e-9 * own.whitening[0].norm());
  }
  const auto again = AdjustBundle(record->data, record->state, record->options);
  ASSERT_TRUE(again.ok());
  EXPECT_NEAR(again->TotalChi2(), calibration.bundle.TotalChi2(), 1e-7);
  EXPECT_DOUBLE_EQ(record->sigma0, calibration.sigma0);
}

TEST(CalibrationRecord, ResidualsOfAnotherCalibrationAreRefused) {
  testing_support::SyntheticOptions options;
  options.poses = 6;
  const SyntheticArray array = MakeSyntheticArray(options);
  Calibration calibration = MustCalibrate(array);
  const ScratchFolder folder("calibration_record");
  Save(array, calibration, folder);
  calibration.data.boards.pop_back();
  std::ofstream(folder.path() / "residuals.csv") << ResidualsCsv(array.session, calibration);
  const auto record = ReadCalibrationRecord(array.session, folder.path());
  ASSERT_FALSE(record.ok());
  EXPECT_NE(record.error().message.find("not made together"), std::string::npos)
      << record.error().message;
}

}  // namespace
}  // namespace telestrain
