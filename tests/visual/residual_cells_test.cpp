#include <gtest/gtest.h>

#include <cmath>

#include "visual/edited_results.h"
#include "visual/results_fixture.h"
#include "viz/scene_from_results.h"

namespace telestrain::viz {
namespace {

using visual_test::FreshFolder;
using visual_test::WriteResults;

constexpr char kHeader[] =
    "image,view,column,row,u_px,v_px,du_px,dv_px,cov_uu_px2,cov_uv_px2,cov_vv_px2\n";

Result<Scene> SceneWith(const std::string& name, const std::string& residuals) {
  const auto folder = FreshFolder(name);
  WriteResults(folder, {.ruler = false, .pipe = false});
  EXPECT_TRUE(WriteFileAtomically(folder / "residuals.csv", residuals).ok());
  return SceneFromResults(folder);
}

std::string Row(const std::string& view, const std::string& numbers) {
  return "calibration/0.png," + view + ",0,0," + numbers + ",1e-6,0,1e-6\n";
}

TEST(ResidualCells, AreMeansOverTwelveTimesNinePartsOfEveryRegion) {
  // Every region is 1296 x 972 px, a cell 108 x 108.
  const auto scene = SceneWith(
      "Cells", kHeader + Row("B2", "2591.5,1943.5,0.5,0") +  // far corner of the last region
                   Row("A1", "10,20,0.01,0.02") + Row("A1", "107.4,107.4,0.03,-0.04") +  // first
                   Row("A1", "107.6,20,-0.1,0") +   // the next column
                   Row("B1", "1296,108,0.2,0.1"));  // second row of the third view
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  const auto& cells = scene->residual_cells;
  ASSERT_EQ(cells.size(), 4u);  // view by view, row by row
  EXPECT_EQ(cells[0].center_px, Eigen::Vector2d(53.5, 53.5));
  EXPECT_EQ(cells[0].corners, 2);
  EXPECT_NEAR(cells[0].mean_px.x(), 0.02, 1e-15);
  EXPECT_NEAR(cells[0].mean_px.y(), -0.01, 1e-15);
  EXPECT_NEAR(cells[0].rms_px, std::sqrt((1e-4 + 4e-4 + 9e-4 + 16e-4) / 4), 1e-15);
  EXPECT_EQ(cells[1].center_px, Eigen::Vector2d(161.5, 53.5));
  EXPECT_EQ(cells[1].mean_px, Eigen::Vector2d(-0.1, 0));
  EXPECT_EQ(cells[1].corners, 1);
  EXPECT_EQ(cells[2].center_px, Eigen::Vector2d(1296 + 53.5, 161.5));
  EXPECT_EQ(cells[3].center_px, Eigen::Vector2d(2592 - 54.5, 1944 - 54.5));
  EXPECT_NEAR(cells[3].rms_px, 0.5 / std::sqrt(2.0), 1e-15);
}

TEST(ResidualCells, AreNotThereWithoutTheFile) {
  const auto folder = FreshFolder("NoCells");
  WriteResults(folder, {.ruler = false, .pipe = false});
  const auto scene = SceneFromResults(folder);
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  EXPECT_TRUE(scene->residual_cells.empty());
}

TEST(ResidualCells, NameTheLineThatIsWrong) {
  const std::string good = Row("A1", "10,20,0.01,0.02");
  const struct {
    std::string text, named;
  } cases[] = {{kHeader + good + Row("C1", "10,20,0.01,0.02"), "line 3: view"},
               {kHeader + good + Row("A1", "10,20,nan,0.02"), "line 3: du_px"},
               {kHeader + good + Row("A1", "1296,20,0.01,0.02"), "line 3: u_px, v_px"},
               {"image,view,u_px,v_px,du_px\n", "'dv_px' is missing"}};
  for (const auto& damage : cases) {
    const auto scene = SceneWith("BadCells", damage.text);
    ASSERT_FALSE(scene.ok()) << damage.named;
    const std::string& message = scene.error().message;
    for (const std::string& part :
         {std::string("residuals.csv"), damage.named, std::string("'telestrain calibrate'")})
      EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace telestrain::viz
