#include "tests/unit/session/malformed.h"

#include <gtest/gtest.h>

#include "session/session.h"
#include "tests/unit/session/sample_folder.h"

namespace telestrain {

void PrintTo(const Malformed& malformed, std::ostream* out) { *out << malformed.name; }

void ExpectRefused(const Malformed& malformed) {
  const SampleFolder sample(malformed.name);
  sample.Replace(malformed.file, malformed.from, malformed.to);
  const auto session = ReadSession(sample.path());
  ASSERT_FALSE(session.ok());
  EXPECT_EQ(session.error().kind, ErrorKind::kBadInput);
  const std::string& message = session.error().message;
  const std::string place = (sample.path() / malformed.file).string() + ":" +
                            std::to_string(sample.LineOf(malformed.file, malformed.line_of)) + ": ";
  EXPECT_TRUE(message.starts_with(place)) << message << "\nwanted at " << place;
  for (const std::string& words : malformed.says)
    EXPECT_NE(message.find(words), std::string::npos) << message << "\nlacks: " << words;
}

}  // namespace telestrain
