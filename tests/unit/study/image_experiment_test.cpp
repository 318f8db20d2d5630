#include "study/image_experiment.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/unit/base/scratch_folder.h"

namespace telestrain {
namespace {

VirtualExperimentOptions Small() {
  VirtualExperimentOptions options;
  options.binning = 4;
  options.poses = 4;
  options.cut_off_poses = 0;
  options.ruler_images = 2;
  options.pipe_states = 3;
  return options;
}

class ImageExperiment : public ::testing::Test {
 protected:
  Result<ImageOutcome> Run(const VirtualExperimentOptions& options) {
    return RunImageExperiment(options, scratch_.path(), "session", console_);
  }
  ScratchFolder scratch_{"telestrain_image_experiment_"};
  std::ostringstream out_;
  Console console_{out_, out_, false};
};

TEST_F(ImageExperiment, TakesASessionThroughTheWholeChain) {
  const auto outcome = Run(Small());
  ASSERT_TRUE(outcome.ok()) << outcome.error().message;
  EXPECT_EQ(outcome->BoardsUsed(), outcome->BoardViews());
  EXPECT_EQ(outcome->RulerErrors_um().size(), 2u);
  ASSERT_EQ(outcome->StrainErrors_microstrain().size(), 2u);
  // Twelve of the stated standard uncertainty's: a wrong truth or state would be off by hundreds.
  const double u = 1e6 * outcome->pipe.states[1].strain.standard_uncertainty;
  EXPECT_LT(std::abs(outcome->StrainErrors_microstrain()[0]), 12 * u);
  EXPECT_NEAR(outcome->true_axial_microstrain[1], 750, 10);  // less the bending of 5
}

TEST_F(ImageExperiment, WithoutPipeStatesNoPipeIsMeasured) {
  VirtualExperimentOptions options = Small();
  options.pipe_states = 0;
  const auto outcome = Run(options);
  ASSERT_TRUE(outcome.ok()) << outcome.error().message;
  EXPECT_TRUE(outcome->pipe.states.empty());
  EXPECT_TRUE(outcome->StrainErrors_microstrain().empty());
}

TEST_F(ImageExperiment, ReplacesItsOwnSessionButNoForeignFile) {
  VirtualExperimentOptions options = Small();
  options.pipe_states = 0;
  ASSERT_TRUE(Run(options).ok());
  ASSERT_TRUE(Run(options).ok());
  const auto foreign = scratch_.path() / "session" / "notes.txt";
  std::ofstream(foreign) << "mine";
  const auto refused = Run(options);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().kind, ErrorKind::kBadInput);
  EXPECT_NE(refused.error().message.find("notes.txt"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(foreign));
  std::filesystem::remove(foreign);
  // A recorded session has no truth beside it: it is never touched.
  std::filesystem::remove(scratch_.path() / "session-truth.json");
  const auto recorded = Run(options);
  ASSERT_FALSE(recorded.ok());
  EXPECT_NE(recorded.error().message.find("no study wrote"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(scratch_.path() / "session" / "session.toml"));
}

}  // namespace
}  // namespace telestrain
