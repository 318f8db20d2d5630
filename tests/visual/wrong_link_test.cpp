#include <gtest/gtest.h>

#include <sstream>

#include "visual/results_fixture.h"
#include "viz/render.h"

namespace telestrain {
namespace {

// This program has libOpenGL ahead of libOSMesa: rendering would draw nothing and report nothing.
TEST(LinkOptions, AreCheckedBeforeAPictureIsDrawn) {
  const auto folder = visual_test::FreshFolder("WrongLink");
  visual_test::WriteResults(folder, {.ruler = false, .pipe = false});
  std::ostringstream out, err;
  Console console(out, err, false);
  const Status status = RenderResults(folder, {}, console);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::kOutputFailed);
  EXPECT_NE(status.error().message.find("libOSMesa"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "pictures/array.png"));
}

}  // namespace
}  // namespace telestrain
