#include "base/late_library.h"

#include <gtest/gtest.h>

namespace telestrain {
namespace {

TEST(LateLibrary, GivesTheFunctionsThatItHas) {
  const LateLibrary math("libm.so.6");
  EXPECT_EQ(math.Failure(), "");
  auto* const cosine = math.Find<double(double)>("cos");
  ASSERT_NE(cosine, nullptr);
  EXPECT_EQ(cosine(0), 1);
  EXPECT_EQ(math.Find<void()>("no_such_function"), nullptr);
  EXPECT_EQ(math.Failure(),
            "libm.so.6 has no function no_such_function; install that library as this release of "
            "Debian has it");
}

TEST(LateLibrary, SaysWhatIsNotThere) {
  const LateLibrary none("libnone_of_this_name.so.1");
  EXPECT_EQ(none.Find<void()>("f"), nullptr);
  for (const char* part : {"libnone_of_this_name.so.1", "install the Debian package"})
    EXPECT_NE(none.Failure().find(part), std::string::npos) << none.Failure();
}

}  // namespace
}  // namespace telestrain
