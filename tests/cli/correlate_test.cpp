#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "base/csv.h"
#include "base/numbers.h"
#include "cli/program_run.h"
#include "unit/base/scratch_folder.h"
#include "unit/correlation/speckle.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 160, kHeight = 128;
constexpr char kColumns[] = "x_px,y_px,u_px,v_px,exx,eyy,exy,zncc,sigma_u_px,sigma_v_px,status";

// A folder with a reference, ref.png, of an analytic speckle pattern.
class Correlate : public ::testing::Test {
 protected:
  Correlate() : scratch_("telestrain_correlate_"), speckle_(7, kWidth, kHeight) {
    Save("ref.png", {0, 0}, CV_8U);
  }

  const fs::path& folder() const { return scratch_.path(); }
  fs::path out() const { return folder() / "out"; }

  // The pattern moved; `type` is CV_8U or CV_16U (257 times the grey level: the same scale).
  void Save(const std::string& name, const Eigen::Vector2d& moved_px, int type) const {
    ShapeFunction map;
    map.displacement_px = moved_px;
    const GrayImage image = speckle_.Render(kWidth, kHeight, map);
    const cv::Mat gray(kHeight, kWidth, CV_32F, const_cast<float*>(image.pixels.data()));
    cv::Mat pixels;
    gray.convertTo(pixels, type, type == CV_16U ? 257 : 1);
    ASSERT_TRUE(cv::imwrite((folder() / name).string(), pixels));
  }

  // A black box in a copy of an image.
  void SaveWithHole(const std::string& from, const std::string& to, const cv::Rect& hole) const {
    cv::Mat pixels = cv::imread((folder() / from).string(), cv::IMREAD_UNCHANGED);
    pixels(hole).setTo(0);
    ASSERT_TRUE(cv::imwrite((folder() / to).string(), pixels));
  }

  void SaveMask(const std::string& name, int width, int height, const cv::Rect& inside) const {
    cv::Mat mask = cv::Mat::zeros(height, width, CV_8U);
    mask(inside).setTo(1);
    ASSERT_TRUE(cv::imwrite((folder() / name).string(), mask));
  }

  // `telestrain correlate` in the folder, with --out out.
  ProgramRun Run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "correlate");
    arguments.insert(arguments.end(), {"--out", "out"});
    return RunTelestrain(arguments, {folder(), {}, false});
  }

  CsvTable Table(const std::string& name) const {
    return ParseCsv(name, ReadAll(out() / name)).value();
  }
  nlohmann::json Record() const { return nlohmann::json::parse(ReadAll(out() / "correlate.json")); }

  void ExpectFailure(const std::vector<std::string>& arguments, int code,
                     std::initializer_list<std::string> parts) const {
    const ProgramRun run = Run(arguments);
    EXPECT_EQ(run.exit_code, code) << run.err;
    for (const std::string& part : parts)
      EXPECT_NE(run.err.find(part), std::string::npos) << "wanted: " << part << "\nis: " << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_FALSE(fs::exists(out()));
  }

 private:
  ScratchFolder scratch_;
  Speckle speckle_;
};

double MeanOf(const CsvTable& table, const std::string& column) {
  const auto at = static_cast<std::size_t>(table.Find(column));
  double sum = 0;
  for (const auto& row : table.rows) sum += ParseDouble(row.cells.at(at)).value();
  return sum / static_cast<double>(table.rows.size());
}

TEST_F(Correlate, ReadsEveryFormatAndFindsTheShift) {
  const std::map<std::string, std::pair<Eigen::Vector2d, int>> images = {
      {"one 8 bit.png", {{0.25, -0.5}, CV_8U}},
      {"two.tif", {{1.5, 2.25}, CV_16U}},
      {"three.v1.bmp", {{-3.125, 0.75}, CV_8U}},
      {"four.pgm", {{0.375, -6.5}, CV_16U}}};
  // So far from the edges that no subset leaves the image: 21 px of subset, 6.5 px of shift.
  std::vector<std::string> arguments{"ref.png", "--subset-px", "21",          "--step-px",
                                     "5",       "--region",    "30,30,100,68"};
  for (const auto& [name, what] : images) {
    Save(name, what.first, what.second);
    arguments.push_back(name);
  }
  const ProgramRun run = Run(arguments);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_TRUE(run.out.starts_with("pattern    speckles ")) << run.out;
  for (const auto& [name, what] : images) {
    EXPECT_NE(run.out.find("\ncorrelate  " + name + ": "), std::string::npos) << run.out;
    const std::string csv = fs::path(name).stem().string() + ".csv";
    EXPECT_TRUE(ReadAll(out() / csv).starts_with(std::string(kColumns) + "\n"));
    const CsvTable table = Table(csv);
    ASSERT_GT(table.rows.size(), 100U);
    for (const auto& row : table.rows) ASSERT_EQ(row.cells.back(), "ok") << name;
    // Rounding to whole grey levels is the only noise: 4 sigma of a mean of points whose subsets
    // overlap, (step / subset)^2 of them independent; and the engine's bar for bias, 0.2 mpx.
    const double independent = std::sqrt(static_cast<double>(table.rows.size())) * 5 / 21;
    for (const auto& [column, wanted] :
         {std::pair{"u_px", what.first.x()}, {"v_px", what.first.y()}}) {
      const double sigma = MeanOf(table, std::string("sigma_") + column);
      EXPECT_NEAR(MeanOf(table, column), wanted, 2e-4 + 4 * sigma / independent) << name;
    }
  }
  for (const std::string file :
       {"one 8 bit.vtp", "two.png", "pattern.txt", "pattern.json", "pattern.png", "correlate.json"})
    EXPECT_TRUE(fs::exists(out() / file)) << file;
  for (const auto& entry : fs::directory_iterator(out()))
    EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
}

TEST_F(Correlate, APointThatFailsKeepsItsPlaceWithTheReason) {
  Save("moved.png", {0.5, 0.5}, CV_8U);
  SaveWithHole("ref.png", "holed_ref.png", {20, 20, 40, 40});
  SaveWithHole("moved.png", "holed.png", {100, 60, 40, 40});
  const ProgramRun run =
      Run({"holed_ref.png", "holed.png", "--subset-px", "21", "--step-px", "10"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const CsvTable table = Table("holed.csv");
  std::map<std::string, int> counts;
  for (const auto& row : table.rows) {
    ++counts[row.cells.back()];
    if (row.cells.back() == "ok") continue;
    for (std::size_t i = 2; i < 10; ++i) EXPECT_EQ(row.cells[i], "");
  }
  EXPECT_GT(counts["ok"], 50);
  EXPECT_GT(counts["low contrast"], 0);  // in the reference's hole
  EXPECT_GE(counts.size(), 3U);          // and something in the image's
  const auto image = Record()["images"][0];
  EXPECT_EQ(image["points"], table.rows.size());
  for (const auto& [status, count] : counts)
    EXPECT_EQ(image["points_by_status"][status], count) << status;
}

TEST_F(Correlate, AMaskOrARegionSaysWhereThePointsLie) {
  Save("moved.png", {0.5, 0}, CV_8U);
  SaveMask("mask.png", kWidth, kHeight, {40, 30, 60, 50});
  const std::vector<std::string> common{"ref.png",   "moved.png", "--subset-px", "21",
                                        "--step-px", "5",         "--region"};
  for (const std::string region : {"mask.png", "40,30,60,50"}) {
    auto arguments = common;
    arguments.push_back(region);
    const ProgramRun run = Run(arguments);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const CsvTable table = Table("moved.csv");
    EXPECT_EQ(table.rows.size(), 12U * 10U) << region;
    for (const auto& row : table.rows) {
      const int x = ParseInt(row.cells[0]).value(), y = ParseInt(row.cells[1]).value();
      EXPECT_TRUE(x >= 40 && x < 100 && y >= 30 && y < 80) << x << ", " << y;
      // Pixels of the subset outside the mask do not count, those outside a region do.
      const auto inside = [](int at, int low, int high) {
        return std::min(at + 11, high) - std::max(at - 10, low);
      };
      const bool masked =
          region == "mask.png" && 2 * inside(x, 40, 100) * inside(y, 30, 80) < 21 * 21;
      EXPECT_EQ(row.cells.back(), masked ? "masked" : "ok");
    }
  }
}

TEST_F(Correlate, WithoutImagesOnlyAssessesThePattern) {
  const ProgramRun run = Run({"ref.png"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto pattern = nlohmann::json::parse(ReadAll(out() / "pattern.json"));
  EXPECT_EQ(pattern["used_subset_px"], pattern["recommended_subset_px"]);
  EXPECT_EQ(pattern["used_step_px"], pattern["recommended_step_px"]);
  EXPECT_TRUE(Record()["images"].empty());
  EXPECT_NE(run.out.find("recommended subset "), std::string::npos) << run.out;
  for (const auto& entry : fs::directory_iterator(out()))
    EXPECT_NE(entry.path().extension(), ".csv") << entry.path();
}

TEST_F(Correlate, ImagesOfOneNameGetNamesOfTheirOwn) {
  fs::create_directories(folder() / "a");
  fs::create_directories(folder() / "b");
  Save("a/load.png", {0.5, 0}, CV_8U);
  Save("b/load.png", {0.25, 0}, CV_8U);
  Save("pattern.png", {0.125, 0}, CV_8U);
  const ProgramRun run = Run({"ref.png", "a/load.png", "b/load.png", "pattern.png", "--subset-px",
                              "31", "--step-px", "20"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  // Half of the 0.25 px by which the images differ: the means are that close to their truth.
  EXPECT_NEAR(MeanOf(Table("load.csv"), "u_px"), 0.5, 0.06);
  EXPECT_NEAR(MeanOf(Table("load_2.csv"), "u_px"), 0.25, 0.06);
  EXPECT_NEAR(MeanOf(Table("pattern_2.csv"), "u_px"), 0.125, 0.06);
  EXPECT_EQ(Record()["images"][1]["results"][0], "load_2.csv");
}

TEST_F(Correlate, NeverWritesOverItsInput) {
  Save("moved.png", {0.5, 0}, CV_8U);
  const std::string bytes = ReadAll(folder() / "moved.png");
  const ProgramRun run =
      RunTelestrain({"correlate", "ref.png", "moved.png", "--out", "."}, {folder(), {}, false});
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_NE(run.err.find("another folder"), std::string::npos) << run.err;
  EXPECT_EQ(ReadAll(folder() / "moved.png"), bytes);
  EXPECT_FALSE(fs::exists(folder() / "pattern.txt"));
}

TEST_F(Correlate, GivesTheSameBytesForAnyNumberOfThreadsAndAgain) {
  Save("a.png", {0.5, 0.25}, CV_8U);
  Save("b.png", {1.0, 0.5}, CV_8U);
  const std::vector<std::string> common{"ref.png", "a.png", "b.png", "--threads"};
  std::map<std::string, std::string> first;
  for (const std::string threads : {"1", "2", "3"}) {
    auto arguments = common;
    arguments.push_back(threads);
    const ProgramRun run = Run(arguments);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    auto bytes = BytesBelow(out());
    bytes["stdout"] = run.out;
    if (first.empty()) first = bytes;
    EXPECT_TRUE(bytes == first) << threads;
  }
}

TEST_F(Correlate, WrongUsageNamesTheLimitAndTheRemedy) {
  Save("moved.png", {0.5, 0}, CV_8U);
  const auto with = [](std::vector<std::string> options) {
    options.insert(options.begin(), {"ref.png", "moved.png"});
    return options;
  };
  ExpectFailure(with({"--subset-px", "32"}), 2, {"odd", "31 or 33"});
  ExpectFailure(with({"--subset-px", "9"}), 2, {"11 and 601"});
  ExpectFailure(with({"--subset-px", "601"}), 2, {"160 x 128 px", "the largest that fits has"});
  ExpectFailure(with({"--step-px", "0"}), 2, {"1 px"});
  ExpectFailure(with({"--order", "3"}), 2, {"--order"});
  ExpectFailure(with({"--strain-window", "4"}), 2, {"odd", "3 to 101"});
  ExpectFailure(with({"--region", "100,0,61,20"}), 2, {"160 x 128 px", "inside it"});
  ExpectFailure(with({"--region", "-1,0,10,10"}), 2, {"inside it"});
  ExpectFailure(with({"--region", "0,0,2147483647,2147483647"}), 2, {"inside it"});
  ExpectFailure(with({"--region", "0,0,0,10"}), 2, {"empty"});
  ExpectFailure(with({"--region", "0,0,10"}), 2, {"four", "x,y,width,height"});
  ExpectFailure(with({"--region", "0,0,10.5,3"}), 2, {"whole numbers"});
}

TEST_F(Correlate, BadImagesAndMasksAreNamedBeforeAnythingIsWritten) {
  Save("moved.png", {0.5, 0}, CV_8U);
  SaveMask("small.png", 80, 80, {10, 10, 20, 20});
  SaveMask("empty.png", kWidth, kHeight, {0, 0, 0, 0});
  const std::string bytes = ReadAll(folder() / "moved.png");
  std::ofstream(folder() / "short.png", std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  std::ofstream(folder() / "text.png") << "no image";
  ExpectFailure({"none.png"}, 3, {"none.png"});
  ExpectFailure({"ref.png", "moved.png", "none.png"}, 3, {"none.png"});
  ExpectFailure({"ref.png", "moved.png", "small.png"}, 3, {"small.png", "80 x 80", "160 x 128"});
  ExpectFailure({"ref.png", "short.png"}, 3, {"short.png", "breaks off"});
  ExpectFailure({"text.png"}, 3, {"text.png"});
  ExpectFailure({"ref.png", "moved.png", "--region", "small.png"}, 3, {"mask", "80 x 80"});
  ExpectFailure({"ref.png", "moved.png", "--region", "empty.png"}, 3, {"every pixel", "is 0"});
  ExpectFailure({"ref.png", "moved.png", "--region", "none.png"}, 3, {"none.png"});
}

TEST_F(Correlate, AFileInPlaceOfTheOutputFolderIsNamed) {
  std::ofstream(out()) << "a file";
  const ProgramRun run = Run({"ref.png"});
  EXPECT_EQ(run.exit_code, 5) << run.err;
  EXPECT_NE(run.err.find("out"), std::string::npos);
  EXPECT_EQ(ReadAll(out()), "a file");
}

TEST_F(Correlate, AnImageOfSomethingElseEndsWithFourAndAllResults) {
  cv::Mat noise(kHeight, kWidth, CV_8U);
  cv::RNG random(3);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::imwrite((folder() / "other.png").string(), noise);
  Save("moved.png", {0.5, 0}, CV_8U);
  const ProgramRun run = Run({"ref.png", "other.png", "moved.png", "--subset-px", "31"});
  EXPECT_EQ(run.exit_code, 4) << run.err;
  EXPECT_NE(run.err.find("other.png"), std::string::npos) << run.err;
  EXPECT_EQ(Record()["images"][0]["points_by_status"]["ok"], 0);
  EXPECT_TRUE(Record()["images"][0]["mean_u_px"].is_null());
  EXPECT_GT(Record()["images"][1]["points_by_status"]["ok"], 10);
}

}  // namespace
}  // namespace telestrain::testing_support
