#include "measurement/state_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace telestrain {
namespace {

StateRecord Example() {
  StateRecord record;
  record.image = "pipe/a \"b\".png";
  record.made_from = {{"image", "00ff"}, {"options", "subset_px 61"}};
  record.surface_sha256 = "abcd";
  StateStrain& strain = record.state.strain;
  strain.axial_strain = 1.0 / 3 * 1e-4;
  strain.standard_uncertainty = 5e-324;
  strain.local_axial_strain = {1e-4 / 7, std::numeric_limits<double>::quiet_NaN()};
  strain.local_hoop_strain = {-0.0, 0.1 * 1e100};
  strain.local_sigma = 0.1 + 0.2;
  strain.translation_mm = {1.1, -2.2 / 3, 3.3};
  strain.rotation_rad = {1e-9 / 3, 0, -1};
  strain.points_used = 431;
  strain.points_rejected = {{"low correlation", 3}};
  strain.budget = {{"image noise", 1e-7 / 3}};
  record.state.motions.resize(4);
  record.state.motions[2].shift_px = {0.1, 1e-17};
  record.state.motions[3].gradient << 1, 2, 3, 1.0 / 3;
  return record;
}

TEST(StateRecord, ReadsBackToTheBit) {
  const StateRecord record = Example();
  const std::string line = StateRecordLine(record);
  EXPECT_EQ(line.find('\n'), line.size() - 1);
  const auto read = ReadStateRecord(line);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(StateRecordLine(*read), line);
  EXPECT_EQ(read->image, record.image);
  EXPECT_EQ(read->made_from, record.made_from);
  EXPECT_TRUE(read->state.motions == record.state.motions);
  const StateStrain &a = record.state.strain, &b = read->state.strain;
  EXPECT_EQ(a.axial_strain, b.axial_strain);
  EXPECT_EQ(a.standard_uncertainty, b.standard_uncertainty);
  EXPECT_EQ(a.local_axial_strain[0], b.local_axial_strain[0]);
  EXPECT_TRUE(std::isnan(b.local_axial_strain[1]));
  EXPECT_EQ(a.local_hoop_strain, b.local_hoop_strain);
  EXPECT_EQ(a.translation_mm, b.translation_mm);
  EXPECT_EQ(a.rotation_rad, b.rotation_rad);
  EXPECT_EQ(a.points_rejected, b.points_rejected);
  ASSERT_EQ(b.budget.size(), 1u);
  EXPECT_EQ(a.budget[0].standard_uncertainty, b.budget[0].standard_uncertainty);
}

TEST(StateRecord, AnyPartOfALineIsNone) {
  const std::string line = StateRecordLine(Example());
  for (std::size_t length = 0; length + 1 < line.size(); ++length)
    EXPECT_FALSE(ReadStateRecord(line.substr(0, length)).ok()) << length;
}

TEST(StateRecord, AnotherVersionIsNone) {
  std::string line = StateRecordLine(Example());
  line.replace(line.find("strain_state/1"), 14, "strain_state/2");
  EXPECT_FALSE(ReadStateRecord(line).ok());
}

TEST(StateRecord, TheOptionsThatDecideAreNamedAndTheThreadsAreNot) {
  PipeOptions options, other;
  other.threads = 7;
  EXPECT_EQ(PipeOptionsText(options), PipeOptionsText(other));
  other.step_px = 30;
  EXPECT_NE(PipeOptionsText(options), PipeOptionsText(other));
}

}  // namespace
}  // namespace telestrain
