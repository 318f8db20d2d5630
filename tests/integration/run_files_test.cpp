// What `telestrain run` writes: names, headers, schemas, structure.
#include <gtest/gtest.h>

#include <sstream>

#include "integration/small_run.h"
#include "session/session.h"
#include "target/image_header.h"
#include "target/image_structure.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

class RunFiles : public SmallRun {};

std::vector<std::string> LinesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> WordsOf(const std::string& line) {
  std::vector<std::string> words;
  std::istringstream stream(line);
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

TEST_F(RunFiles, TheVerdictIsPassAndTheProgramSaysSo) {
  EXPECT_NE(Run().out.find("verdict    pass\n"), std::string::npos) << Run().out;
  EXPECT_EQ(ResultJson("results.json").at("verdict"), "pass");
}

TEST_F(RunFiles, EveryFileOfTheResultsTableIsThere) {
  const auto bytes = BytesBelow(Results());
  for (const char* name : {"inputs.json",
                           "corners.vnl",
                           "corner_covariances.csv",
                           "detection.json",
                           "calibration.json",
                           "residuals.csv",
                           "ruler.csv",
                           "ruler.json",
                           "strain.csv",
                           "strain.json",
                           "strain_components.csv",
                           "strain_states.jsonl",
                           "pipe_000.vtp",
                           "pipe_001.vtp",
                           "pipe_002.vtp",
                           "pictures/array.png",
                           "pictures/targets.png",
                           "pictures/pipe_strain.png",
                           "results.json",
                           "report.pdf"}) {
    ASSERT_TRUE(bytes.contains(name)) << name;
    EXPECT_FALSE(bytes.at(name).empty()) << name;
  }
  for (const auto& [name, content] : bytes)
    EXPECT_EQ(name.find("tmp"), std::string::npos) << "left behind: " << name;
}

TEST_F(RunFiles, TablesHaveTheirHeadersAndOneRowPerImage) {
  const auto ruler = LinesOf(ReadAll(Results() / "ruler.csv"));
  ASSERT_EQ(ruler.size(), 1u + 3u);
  EXPECT_EQ(ruler[0], "image,length_mm,error_um,standard_uncertainty_um");
  EXPECT_TRUE(ruler[1].starts_with("ruler/ruler_001.png,27.6") ||
              ruler[1].starts_with("ruler/ruler_001.png,27.5"));
  const auto strain = LinesOf(ReadAll(Results() / "strain.csv"));
  ASSERT_EQ(strain.size(), 1u + 3u);
  EXPECT_EQ(strain[0],
            "image,cycle,step,axial_microstrain,standard_uncertainty_microstrain,"
            "local_a_microstrain,local_b_microstrain,gauge_mean_microstrain");
  EXPECT_TRUE(strain[3].starts_with("pipe/pipe_002.png,1,2,"));
  const auto components = LinesOf(ReadAll(Results() / "strain_components.csv"));
  ASSERT_EQ(components.size(), 1u + 3u);
  EXPECT_TRUE(components[0].starts_with("image,cycle,step,membrane_microstrain,"));
  EXPECT_TRUE(components[3].starts_with("pipe/pipe_002.png,1,2,"));
  const auto covariances = LinesOf(ReadAll(Results() / "corner_covariances.csv"));
  EXPECT_EQ(covariances[0], "image,view,column,row,cov_uu_px2,cov_uv_px2,cov_vv_px2");
  const auto residuals = LinesOf(ReadAll(Results() / "residuals.csv"));
  EXPECT_EQ(residuals[0],
            "image,view,column,row,u_px,v_px,du_px,dv_px,cov_uu_px2,cov_uv_px2,cov_vv_px2");
  EXPECT_EQ(residuals.size(), covariances.size());  // no corner was rejected
}

TEST_F(RunFiles, CornersComeInOneBlockPerImageAndView) {
  const auto session = ReadSession(SmallSession());
  ASSERT_TRUE(session.ok());
  const auto lines = LinesOf(ReadAll(Results() / "corners.vnl"));
  ASSERT_EQ(lines.at(0), "# filename x y level");
  std::size_t at = 1;
  for (const CalibrationImage& image : session->calibration_images)
    for (const NominalView& view : session->views) {
      const std::string name = image.image + "#" + view.name;
      int missing = 0;
      for (std::size_t i = 0; i < 13 * 9; ++i, ++at) {
        const auto words = WordsOf(lines.at(at));
        ASSERT_EQ(words.size(), 4u) << lines[at];
        ASSERT_EQ(words[0], name);
        ASSERT_TRUE(words[3] == "0" || lines[at] == name + " - - -") << lines[at];
        missing += words[3] == "-";
      }
      // Of 40 boards one is cut off, by a row.
      EXPECT_EQ(missing, name == "calibration/pose_003_stage_0.png#A2" ? 13 : 0) << name;
    }
  EXPECT_EQ(at, lines.size());
}

TEST_F(RunFiles, JsonFilesNameTheirSchemaAndWhatTheyWereMadeFrom) {
  const std::map<std::string, std::vector<std::string>> keys{
      {"inputs", {"program", "title", "sensor", "lens", "target", "ruler", "pipe", "files"}},
      {"detection", {"made_from", "boards", "crosses"}},
      {"calibration",
       {"made_from", "sensor", "lens", "views", "poses", "rejected", "reprojection",
        "stage_decision", "model_tests", "gauge", "covariance"}},
      {"mrcal", {"made_from", "independent_optimum", "residuals", "pinhole"}},
      {"ruler", {"made_from", "nominal_length_mm", "images", "summary", "budget"}},
      {"strain",
       {"made_from", "pipe", "options", "base_length_mm", "states", "comparison", "budget"}},
      {"results", {"verdict", "quantities", "tables"}}};
  for (const auto& [name, wanted] : keys) {
    const auto json = ResultJson(name + ".json");
    EXPECT_EQ(json.at("schema"), "telestrain." + name + "/1");
    for (const std::string& key : wanted) EXPECT_TRUE(json.contains(key)) << name << ' ' << key;
  }
  const auto calibration = ResultJson("calibration.json");
  for (const char* key : {"rms_px", "mean_px", "max_px", "corners_used", "corners_rejected"})
    EXPECT_TRUE(calibration.at("reprojection").contains(key)) << key;
  ASSERT_EQ(calibration.at("views").size(), 4u);
  for (const auto& view : calibration.at("views"))
    for (const char* key : {"name", "image_x_in_array", "image_y_in_array", "offset_px"})
      EXPECT_TRUE(view.contains(key)) << key;
}

// On exact models of the same corners both programs find the same minimum to the last digits.
TEST_F(RunFiles, MrcalAgreesAndTheResidualsAreNoise) {
  const auto json = ResultJson("mrcal.json");
  const auto& optimum = json.at("independent_optimum");
  EXPECT_EQ(optimum.at("agrees"), true);
  for (const char* key : {"max_residual_difference_px", "evaluated_max_residual_difference_px"})
    EXPECT_LT(optimum.at(key).get<double>(), 1e-6) << key;
  EXPECT_LT(optimum.at("max_magnification_difference").get<double>(), 1e-8);
  EXPECT_LT(optimum.at("max_rotation_difference_rad").get<double>(), 1e-8);
  EXPECT_EQ(json.at("residuals").at("verdict").at("kind"), "noise");
  EXPECT_EQ(json.at("residuals").at("corners"),
            ResultJson("calibration.json").at("reprojection").at("corners_used"));
  EXPECT_NEAR(json.at("residuals").at("rms_px").get<double>(),
              ResultJson("calibration.json").at("reprojection").at("rms_px").get<double>(), 1e-9);
}

TEST_F(RunFiles, TheCovarianceIsSquareAndOfTheNamedParameters) {
  const auto covariance = ResultJson("calibration.json").at("covariance");
  const std::size_t count = covariance.at("parameters").size();
  ASSERT_EQ(covariance.at("matrix").size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    ASSERT_EQ(covariance.at("matrix").at(i).size(), count);
    EXPECT_GT(covariance.at("matrix").at(i).at(i).get<double>(), 0);
  }
}

TEST_F(RunFiles, SurfacesCarryTheirPointData) {
  for (const char* name : {"pipe_000.vtp", "pipe_001.vtp", "pipe_002.vtp"}) {
    const std::string text = ReadAll(Results() / name);
    EXPECT_NE(text.find("<VTKFile type=\"PolyData\""), std::string::npos);
    for (const char* array :
         {"displacement_mm", "axial_microstrain", "hoop_microstrain", "zncc", "sigma_um", "group"})
      EXPECT_NE(text.find(std::string("Name=\"") + array + "\""), std::string::npos) << array;
  }
}

TEST_F(RunFiles, PicturesAreWideEnoughForPrint) {
  for (const char* name : {"array", "targets", "pipe_strain"}) {
    const std::string png = ReadAll(Results() / "pictures" / (std::string(name) + ".png"));
    ASSERT_TRUE(SizeFromHeader(png).has_value()) << name;
    EXPECT_EQ(SizeFromHeader(png)->width_px, 2008) << name;  // 170 mm at 300 dpi
    EXPECT_EQ(StructureFault(png), "") << name;
  }
  EXPECT_TRUE(ReadAll(Results() / "report.pdf").starts_with("%PDF-"));
}

TEST_F(RunFiles, EveryInputFileIsRecordedWithItsSize) {
  std::map<std::string, std::size_t> recorded;
  const auto inputs = ResultJson("inputs.json");
  for (const auto& file : inputs.at("files")) recorded[file.at("path")] = file.at("bytes");
  std::map<std::string, std::size_t> sizes;
  for (const auto& [name, bytes] : BytesBelow(SmallSession())) sizes[name] = bytes.size();
  EXPECT_EQ(recorded, sizes);
}

}  // namespace
}  // namespace telestrain::testing_support
