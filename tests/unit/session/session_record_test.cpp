#include "session/session_record.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/unit/session/sample_folder.h"

namespace telestrain {
namespace {

TEST(SessionRecord, ReadsBackToTheSameRecord) {
  const SampleFolder sample("session_record");
  const auto session = ReadSession(sample.path());
  ASSERT_TRUE(session.ok()) << session.error().message;
  nlohmann::ordered_json record = SessionRecord(*session);
  nlohmann::ordered_json again = SessionRecord(SessionOfRecord(record));
  record["counts"].erase("pipe_images");  // the states are not part of it
  again["counts"].erase("pipe_images");
  EXPECT_EQ(again, record);
}

TEST(SessionRecord, AMissingKeyThrows) {
  EXPECT_THROW(SessionOfRecord({{"title", "x"}}), nlohmann::json::exception);
}

// They become the sizes of lists.
TEST(SessionRecord, CountsOutsideTheLimitsThrow) {
  const SampleFolder sample("session_record_counts");
  const auto session = ReadSession(sample.path());
  ASSERT_TRUE(session.ok()) << session.error().message;
  const nlohmann::ordered_json record = SessionRecord(*session);
  for (const auto& [pointer, value] :
       {std::pair<const char*, double>("/target/columns", 2147483647),
        {"/target/rows", -1},
        {"/target/rows", 3.5},
        {"/sensor/width_px", 1e300},
        {"/views/0/region_px/2", 65537}}) {
    nlohmann::ordered_json wrong = record;
    wrong[nlohmann::ordered_json::json_pointer(pointer)] = value;
    EXPECT_THROW(SessionOfRecord(wrong), nlohmann::json::exception) << pointer;
  }
}

}  // namespace
}  // namespace telestrain
