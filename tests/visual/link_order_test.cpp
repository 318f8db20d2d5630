#include <gtest/gtest.h>

#include "visual/results_fixture.h"

std::string RenderThroughAnotherLibrary(const std::string& folder);

namespace telestrain {
namespace {

// This program names OpenGL's own library ahead of the one that hides telestrain::viz.
TEST(LinkOptions, ReachTheProgramThroughAnotherLibraryInAnyOrder) {
  const auto folder = visual_test::FreshFolder("LinkOrder");
  visual_test::WriteResults(folder, {.ruler = false, .pipe = false});
  EXPECT_EQ(RenderThroughAnotherLibrary(folder.string()), "");
}

}  // namespace
}  // namespace telestrain
