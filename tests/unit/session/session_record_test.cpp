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

}  // namespace
}  // namespace telestrain
