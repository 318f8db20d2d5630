// The studies of the paper as a user starts them, at a small share of their full size.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program_run.h"
#include "unit/base/scratch_folder.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

class StudyRun : public ::testing::Test {
 protected:
  // Runs `study name` and returns what it left; the exit code must be 0: every limit is met.
  nlohmann::json Run(const std::string& name, const std::string& share, const std::string& binning,
                     const std::string& threads = "0") {
    const fs::path out = scratch_.path() / (name + "-" + threads);
    const ProgramRun run = RunTelestrain({"study", name, "--out", out.string(), "--share", share,
                                          "--binning", binning, "--threads", threads});
    EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
    for (const char* word : {"quantity", "paper", "ours", "limit", "met"})
      EXPECT_NE(run.out.find(word), std::string::npos) << run.out;
    bytes_ = ReadAll(out / "study.json");
    EXPECT_EQ(ReadAll(out / "study.pdf").substr(0, 5), "%PDF-");
    return nlohmann::json::parse(bytes_);
  }
  // The value in the first row of a table whose first cell begins with `row`.
  static double Cell(const nlohmann::json& study, const std::string& row, std::size_t column) {
    for (const auto& cells : study["tables"][0]["rows"])
      if (cells[0].get<std::string>().starts_with(row)) return cells[column]["value"];
    ADD_FAILURE() << "no row " << row;
    return 0;
  }
  ScratchFolder scratch_{"telestrain_study_"};
  std::string bytes_;
};

TEST_F(StudyRun, PaperSimulationPutsTheTelecentricModelAhead) {
  const auto study = Run("paper-simulation", "0.17", "2");
  EXPECT_LT(Cell(study, "telecentric", 1), 0.1 * Cell(study, "pinhole, D 110 mm", 1));
  EXPECT_LT(Cell(study, "telecentric", 3), Cell(study, "pinhole, D 10 m", 3));
}

TEST_F(StudyRun, PaperSimulationDoesNotDependOnThreads) {
  Run("paper-simulation", "0.02", "4", "1");
  const std::string one = bytes_;
  Run("paper-simulation", "0.02", "4", "3");
  EXPECT_EQ(one, bytes_);
}

TEST_F(StudyRun, PaperCalibrationTellsTheCausesApart) {
  const auto study = Run("paper-calibration", "0.04", "1");
  // Two certificates, each 0.25 um off, in the ruler's error without noise.
  const double systematic_um = Cell(study, "+ certificates", 8);
  EXPECT_NEAR(systematic_um, 0.5, 0.15);
  EXPECT_GT(Cell(study, "+ defocus", 9), 2 * Cell(study, "noise 0.395", 9));
}

TEST_F(StudyRun, PaperStrainSeparatesCameraGaugesAndBench) {
  const auto study = Run("paper-strain", "0.13", "4");
  // Area against point: 0.5 % of the strain.
  EXPECT_NEAR(Cell(study, "area against point", 5), 1 / 1.005, 1e-3);
  EXPECT_LT(Cell(study, "bench bending", 2), -3);
}

}  // namespace
}  // namespace telestrain::testing_support
