#include <gtest/gtest.h>

#include <cmath>

#include "base/json_file.h"
#include "report/acceptance_report.h"
#include "report/color_map.h"
#include "report/json_lookup.h"
#include "results_fixture.h"

namespace telestrain {
namespace {

class DiagnosisResults : public ::testing::Test {
 protected:
  void SetUp() override {
    fixture_ = PlausibleResults();
    fixture_.pictures = false;
  }
  Json& Optimum() { return fixture_.diagnosis["independent_optimum"]; }
  void Make() {
    const auto folder = TestFolder("diagnosis_results");
    WriteResults(fixture_, folder);
    const auto made = MakeResults(folder);
    ASSERT_TRUE(made) << made.error().message;
    outcome_ = *made;
    auto json = ReadJson(folder / "results.json", "telestrain.results/1", "test");
    ASSERT_TRUE(json);
    results_ = *json;
  }
  const Json& Quantity(const std::string& id) const {
    return FindBy(ListAt(results_, "/quantities"), "id", id);
  }
  const Json& Rows(const std::string& table) const {
    return ListAt(FindBy(ListAt(results_, "/tables"), "id", table), "/rows");
  }
  std::string Sentence(const std::string& key) const {
    return TextAt(results_, "/diagnosis/printed_" + key);
  }
  bool SummaryHas(const std::string& text) const {
    for (const Json& row : Rows("summary"))
      if (TextAt(row, "/0").find(text) != std::string::npos) return true;
    return false;
  }

  ResultsFixture fixture_;
  Outcome outcome_;
  Json results_;
};

TEST_F(DiagnosisResults, AgreementPassesInAUnitThatReadsWell) {
  Make();
  EXPECT_EQ(outcome_.verdict, "pass");
  EXPECT_EQ(Sentence("mrcal"), "mrcal agrees.");
  const Json& optimum = Quantity("mrcal_optimum_difference");
  EXPECT_EQ(TextAt(optimum, "/printed"), "0.00020");
  EXPECT_EQ(TextAt(optimum, "/printed_limit"), "≤ 1");
  EXPECT_EQ(TextAt(optimum, "/unit"), "10⁻⁶ px");
  for (const char* id : {"mrcal_optimum_difference", "mrcal_projection_difference"})
    EXPECT_EQ(TextAt(Quantity(id), "/verdict"), "pass") << id;
  EXPECT_TRUE(SummaryHas("mrcal's own optimum"));
  EXPECT_TRUE(SummaryHas("mrcal's projection at our solution"));
  EXPECT_FALSE(SummaryHas("Rotations"));
}

// Every way to disagree must keep the report from being accepted.
TEST_F(DiagnosisResults, EveryDisagreementFailsTheReport) {
  struct Case {
    const char* key;
    Json value;
    const char* row;
  };
  const Json agreed = Optimum();
  for (const Case& c :
       {Case{"max_residual_difference_px", 1.1e-6, "Largest difference to mrcal's own optimum"},
        Case{"evaluated_max_residual_difference_px", 0.3, "mrcal's projection at our solution"},
        Case{"max_magnification_difference", 2e-8, "Magnifications"},
        Case{"max_rotation_difference_rad", 2e-8, "Rotations"},
        Case{"mrcal_converged", false, "mrcal did not converge"},
        Case{"rms_px", 0.01, "mrcal.json says that they disagree"}}) {
    Optimum() = agreed;
    Optimum()[c.key] = c.value;
    Optimum()["agrees"] = false;
    Make();
    EXPECT_EQ(outcome_.verdict, "fail") << c.key;
    EXPECT_FALSE(outcome_.accepted) << c.key;
    EXPECT_TRUE(SummaryHas(c.row)) << c.key;
    EXPECT_NE(Sentence("mrcal").find("DISAGREE"), std::string::npos) << c.key;
  }
}

TEST_F(DiagnosisResults, ADifferenceAboveItsLimitFailsWhateverTheFileClaims) {
  Optimum()["evaluated_max_residual_difference_px"] = 2e-6;
  Make();
  EXPECT_EQ(TextAt(Quantity("mrcal_projection_difference"), "/verdict"), "fail");
  EXPECT_EQ(outcome_.verdict, "fail");
  Optimum()["agrees"] = "perhaps";  // neither true nor null
  Optimum()["evaluated_max_residual_difference_px"] = 1e-10;
  Make();
  EXPECT_EQ(outcome_.verdict, "fail");
}

TEST_F(DiagnosisResults, ACheckThatWasNotMadeIsStatedAndDoesNotDecide) {
  Optimum() = {{"agrees", nullptr}, {"missing_because", "fewer than 3 images are complete"}};
  Make();
  EXPECT_EQ(outcome_.verdict, "pass");
  EXPECT_TRUE(outcome_.accepted);
  EXPECT_TRUE(EntryAt(Quantity("mrcal_optimum_difference"), "/verdict").is_null());
  EXPECT_TRUE(EntryAt(Quantity("mrcal_optimum_difference"), "/limit").is_null());
  EXPECT_TRUE(SummaryHas("not checked: fewer than 3 images are complete"));
  EXPECT_TRUE(Rows("mrcal-check").empty());
}

TEST_F(DiagnosisResults, WithoutTheFileNothingIsDiagnosed) {
  fixture_.diagnosis = nullptr;
  Make();
  EXPECT_EQ(outcome_.verdict, "pass");
  EXPECT_EQ(EntryAt(results_, "/measured/diagnosis"), false);
  EXPECT_FALSE(SummaryHas("mrcal"));
}

TEST_F(DiagnosisResults, AValueThatIsMissingIsNotDecided) {
  Optimum()["max_residual_difference_px"] = "small";
  Make();
  EXPECT_EQ(outcome_.verdict, "undecided");
  EXPECT_FALSE(outcome_.accepted);
}

TEST_F(DiagnosisResults, TheTestsSayInPlainWordsWhatTheirProbabilityMeans) {
  Json& tests = fixture_.diagnosis["residuals"]["tests"];
  tests["normality"]["p_value"] = 0.01;
  tests["smallest_spatial_p"] = 1e-40;
  tests["smallest_trend_p"] = 0.0019;
  Make();
  const Json& rows = Rows("residual-tests");
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(rows[0][4], "They are as large as the corners' stated noise.");
  EXPECT_NE(TextAt(rows[1], "/4").find("A weak sign"), std::string::npos);
  EXPECT_EQ(TextAt(rows[2], "/3/printed"), "< 1e-12");
  EXPECT_EQ(TextAt(rows[2], "/4"), "A clear sign of neighbours that err alike.");
  EXPECT_NE(TextAt(rows[2], "/1").find("view B2, u, field"), std::string::npos);  // smallest p
  EXPECT_EQ(TextAt(rows[3], "/4"), "A clear sign of a drift.");
}

TEST_F(DiagnosisResults, FindingsCarryTheirRemedies) {
  Json& verdict = fixture_.diagnosis["residuals"]["verdict"];
  const Json finding{{"text", "radial distortion k1: 0.02 px RMS."},
                     {"remedy", "Free k1 in the lens model."},
                     {"rms_px", 0.021},
                     {"adjusted_p_value", 1e-30}};
  verdict["findings"].push_back(finding);
  verdict["boards_left_out"].push_back(finding);
  Make();
  const Json& rows = Rows("residual-findings");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0][0], "residuals");
  EXPECT_EQ(TextAt(rows[0], "/2"), "Free k1 in the lens model.");
  EXPECT_EQ(rows[1][0], "board left out");
}

TEST_F(DiagnosisResults, TenWorstBoardsAreListed) {
  Make();
  EXPECT_EQ(Rows("residual-boards").size(), 10u);
  EXPECT_EQ(Rows("outlier-replay").size(), 2u);
  EXPECT_EQ(Rows("residual-views").size(), 5u);  // four and all together
}

TEST_F(DiagnosisResults, ThePinholeStandsBesideTheTelecentricModelOnTheSameRulers) {
  double squares_um2 = 0;
  const Json& images = ListAt(fixture_.ruler, "/images");
  double count = 0;
  for (const Json& image : images)
    if (const auto error_um = NumberAt(image, "/error_um"))
      squares_um2 += *error_um * *error_um, count += 1;
  for (Json& arm : fixture_.diagnosis["pinhole"]["arms"]) arm["ruler_images"] = count;
  Make();
  const Json& rows = Rows("pinhole");
  ASSERT_EQ(rows.size(), 8u);
  EXPECT_DOUBLE_EQ(*NumberAt(rows[0], "/7/value"), std::sqrt(squares_um2 / count));
  EXPECT_EQ(TextAt(rows[2], "/10"), "1 of 3");
  EXPECT_NE(Sentence("pinhole").find("no pinhole without coefficients comes within 1 %"),
            std::string::npos);
  EXPECT_NE(Sentence("pinhole").find("Ruler: the smallest RMSE"), std::string::npos);
  // On other images the two are not comparable.
  fixture_.diagnosis["pinhole"]["arms"][0]["ruler_images"] = 2;
  Make();
  EXPECT_TRUE(EntryAt(Rows("pinhole")[0], "/7/value").is_null());
}

TEST_F(DiagnosisResults, WhereAPinholeIsAsGoodItIsSaid) {
  fixture_.diagnosis["pinhole"]["as_good_from_mm"] = 1e4;
  Make();
  EXPECT_NE(Sentence("pinhole").find("from D = 10 m on a pinhole"), std::string::npos);
  EXPECT_NE(Sentence("pinhole").find("Parallel rays are the limit"), std::string::npos);
  fixture_.diagnosis["pinhole"] = {{"missing_because", "there is one view only"}};
  Make();
  EXPECT_EQ(Sentence("pinhole"), "Not compared with pinhole cameras: there is one view only.");
  EXPECT_EQ(EntryAt(results_, "/measured/pinhole"), false);
}

// A file of the right schema and the wrong content must not throw, and must not pass silently.
TEST_F(DiagnosisResults, WrongTypesAreReadAsMissing) {
  for (const char* part : {"independent_optimum", "residuals", "pinhole"}) {
    fixture_ = PlausibleResults();
    fixture_.diagnosis[part] = 7;
    Make();
    EXPECT_EQ(EntryAt(results_, "/measured/diagnosis"), true) << part;
  }
}

// In grey the map must still tell larger from smaller: its luminance (ITU-R BT.709) only rises.
TEST(ColorMap, ItsLightnessRisesSteadily) {
  double last = -1;
  for (int i = 0; i <= 200; ++i) {
    const Color color = MapColor(i / 200.0);
    const double luminance = 0.2126 * color.red + 0.7152 * color.green + 0.0722 * color.blue;
    EXPECT_GT(luminance, last) << i;
    last = luminance;
  }
  EXPECT_EQ(MapColor(-1).blue, MapColor(0).blue);
  EXPECT_EQ(MapColor(2).red, MapColor(1).red);
}

}  // namespace
}  // namespace telestrain
