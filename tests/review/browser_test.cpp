// The page in a real browser: headless Chromium with the network off, drawing in software. The
// checks themselves are in page_check.mjs.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "cli/program_run.h"
#include "review/review_content.h"

namespace telestrain::review_test {
namespace {

namespace fs = std::filesystem;

const std::string kBrowser = TELESTRAIN_CHROMIUM_PROGRAM;
const std::string kNode = TELESTRAIN_NODE_PROGRAM;
const fs::path kFolder = fs::path(TELESTRAIN_BINARY_DIR) / "tests/review/pages";

class PageInBrowser : public ::testing::Test {
 protected:
  void SetUp() override {
    if (kBrowser.empty()) GTEST_SKIP() << "chromium is not installed";
    if (kNode.empty()) GTEST_SKIP() << "node is not installed";
  }

  // Writes the page and its screenshots to the build tree's test folder.
  static void Check(const std::string& what, const viz::ReviewContent& content) {
    const fs::path page = kFolder / (what + ".html");
    fs::create_directories(kFolder);
    std::ofstream(page, std::ios::binary) << viz::ReviewPage(content).value();
    const auto run =
        testing_support::RunProgram({kNode, TELESTRAIN_SOURCE_DIR "/tests/review/page_check.mjs",
                                     what, kBrowser, page.string()});
    EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  }
};

TEST_F(PageInBrowser, TheSceneTurnsSwitchesAndAnswersClicks) {
  const viz::ReviewContent content = MadeUpContent();
  if (content.vtk_js.script.empty()) GTEST_SKIP() << "built without vtk.js (bash bootstrap build)";
  Check("scene", content);
}

TEST_F(PageInBrowser, WithoutWebGlItShowsThePicturesAndSaysSo) {
  const viz::ReviewContent content = MadeUpContent();
  if (content.vtk_js.script.empty()) GTEST_SKIP() << "built without vtk.js (bash bootstrap build)";
  Check("no_webgl", content);
}

TEST_F(PageInBrowser, WithoutVtkJsItShowsThePicturesAndSaysSo) {
  viz::ReviewContent content = MadeUpContent();
  content.vtk_js = {};
  Check("no_vtk_js", content);
}

TEST_F(PageInBrowser, AHostileSessionRunsNothing) {
  viz::ReviewContent content = MadeUpContent();
  const std::string hostile =
      "</title></script><script>document.title='owned'</script>"
      "<img src=x onerror=\"document.title='owned'\">";
  content.results["title"] = hostile;
  content.results["tables"][0]["rows"][0][0] = hostile;
  content.pictures[0].name = hostile + ".png";
  content.scene.views[0].name = content.scene.boards[1].image = hostile;
  content.scene.pipe->states[1].image = hostile;
  content.list = viz::PartsOf(content.scene);
  Check("hostile", content);
}

}  // namespace
}  // namespace telestrain::review_test
