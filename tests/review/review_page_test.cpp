#include "viz/review/review_page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <regex>

#include "review/review_content.h"
#include "viz/picture_set.h"
#include "viz/review/html_text.h"
#include "viz/review/part_json.h"

namespace telestrain::review_test {
namespace {

using viz::ReviewContent;

std::size_t Count(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

bool Holds(const std::string& text, const std::string& part) { return Count(text, part) > 0; }

std::string PageOf(const ReviewContent& content) { return viz::ReviewPage(content).value(); }

// The page with a stand-in for vtk.js, so that the tests say the same with and without it.
ReviewContent ContentWithScript() {
  ReviewContent content = MadeUpContent();
  content.vtk_js = {"var vtk='</script><!--';\n//# sourceMappingURL=vtk.js.map", "The licence."};
  return content;
}

TEST(ReviewPage, SaysWhatWasDecidedAndWhy) {
  const std::string page = PageOf(MadeUpContent());
  EXPECT_TRUE(Holds(page, "<h1>Bench test</h1>"));
  EXPECT_TRUE(Holds(page, "<span class=\"sign\">\u2713</span> PASS"));
  EXPECT_TRUE(Holds(page, "<dt>Report number</dt><dd>R-7</dd>"));
  EXPECT_TRUE(Holds(page, "<dt>Shift</dt><dd>night</dd>"));
  EXPECT_TRUE(Holds(page, "passes with 1.9 to spare"));
  EXPECT_TRUE(Holds(page, "<code title=\"" + std::string(64, 'a') + "\">aaaaaaaaaaaa\u2026"));
  EXPECT_TRUE(Holds(page, "telestrain 1.2.3"));
}

TEST(ReviewPage, EveryVerdictHasSignAndWord) {
  for (const auto& [verdict, shown] : {std::pair{"pass", "\u2713</span> PASS"},
                                       {"fail", "\u2717</span> FAIL"},
                                       {"doubt", "?</span> IN DOUBT"},
                                       {"undecided", "\u2013</span> NOT DECIDED"}}) {
    ReviewContent content = MadeUpContent();
    content.results["verdict"] = verdict;
    EXPECT_TRUE(Holds(PageOf(content), std::string("<span class=\"sign\">") + shown)) << verdict;
  }
}

// Widths of digits are alike, so that hidden ones put the points of a column under each other.
TEST(ReviewPage, DecimalsOfAColumnAreAligned) {
  const std::string page = PageOf(MadeUpContent());
  EXPECT_TRUE(Holds(page, "<td class=\"number\">100<i>.00</i></td>"));
  EXPECT_TRUE(Holds(page, "<td class=\"number\">\u221212.25</td>"));
  EXPECT_TRUE(Holds(page, "Strain<small>\u00b5\u03b5</small>"));
}

TEST(ReviewPage, NothingOnItLiesElsewhere) {
  const std::string page = PageOf(MadeUpContent());
  // Outside of scripts, where vtk.js names XML namespaces, nothing has an address.
  const std::string document =
      std::regex_replace(page.substr(0, page.find("<script")), std::regex("data:[^\"]*"), "data:");
  EXPECT_FALSE(std::regex_search(document, std::regex("https?:", std::regex::icase)));
  const std::regex reference("\\s(src|href|action|srcset|poster)=\"([^\"]*)\"");
  for (std::sregex_iterator it(document.begin(), document.end(), reference), end; it != end; ++it) {
    const std::string target = (*it)[2];
    EXPECT_TRUE(target.starts_with("#") || target == "data:") << target;
  }
  for (const char* element : {"<link", "<iframe", "<object", "<embed", "<base", "@import", "url("})
    EXPECT_FALSE(Holds(document, element)) << element;
  EXPECT_TRUE(Holds(document, "default-src 'none'"));
}

// A browser runs the scripts whose hashes stand in the head, and no other.
TEST(ReviewPage, OnlyItsOwnScriptsMayRun) {
  const std::string page = PageOf(ContentWithScript());
  std::size_t scripts = 0;
  const std::string open = "<script>", close = "</script>";
  for (std::size_t at = page.find(open); at != std::string::npos; at = page.find(open, at + 1)) {
    const std::size_t begin = at + open.size();
    const std::string script = page.substr(begin, page.find(close, begin) - begin);
    EXPECT_TRUE(Holds(page.substr(0, page.find("</head>")), viz::PolicyHash(script)));
    ++scripts;
  }
  EXPECT_EQ(scripts, 2u);
  EXPECT_EQ(Count(page, close), 3u);  // and the data
  EXPECT_FALSE(Holds(page, "sourceMappingURL"));
  EXPECT_TRUE(Holds(page, "The licence."));
}

TEST(ReviewPage, TextsOfASessionStayTexts) {
  const std::string hostile = "</title></script><script>alert(1)</script><!--\"'><img src=x>{{js}}";
  ReviewContent content = ContentWithScript();
  const std::string before = PageOf(content);
  content.results["title"] = hostile;
  content.results["document"] = {{hostile, hostile}, {"operator", hostile}};
  content.results["decision"]["printed"] = hostile;
  content.results["quantities"][0]["label"] = hostile;
  content.results["tables"][0]["title"] = hostile;
  content.results["tables"][0]["columns"][1]["unit"] = hostile;
  content.results["tables"][0]["rows"][0] = {hostile, hostile};
  content.hashes[0] = {hostile, hostile};
  content.pictures[0].name = hostile + ".png";
  content.version = hostile;
  content.scene.views[0].name = content.scene.boards[0].image = hostile;
  content.scene.pipe->states[0].image = hostile;
  content.list = viz::PartsOf(content.scene);
  const std::string page = PageOf(content);
  for (const char* markup : {"<script", "</script", "<!--", "<img", "</title", "alert(1)</"})
    EXPECT_EQ(Count(page, markup), Count(before, markup)) << markup;
}

TEST(ReviewPage, ItsDataAreThePartsOfTheScene) {
  const ReviewContent content = ContentWithScript();
  const std::string page = PageOf(content);
  const std::string open = "id=\"scene-data\">";
  const std::size_t begin = page.find(open) + open.size();
  const auto json =
      nlohmann::ordered_json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  EXPECT_EQ(json, viz::SceneJson(content.scene, content.list));
}

TEST(ReviewPage, PicturesAreInside) {
  const std::string page = PageOf(MadeUpContent());
  EXPECT_TRUE(Holds(page, "src=\"data:image/png;base64," + viz::Base64(SmallPng()) + "\""));
}

TEST(ReviewPage, PicturesOfAStateAreNamedByItsImage) {
  ReviewContent content = MadeUpContent();
  content.pictures = {{"pipe_strain_001.png", SmallPng()}, {"of_my_own.png", SmallPng()}};
  const std::string page = PageOf(content);
  EXPECT_TRUE(Holds(page, ", pipe/pipe_001.png</figcaption>"));
  EXPECT_TRUE(Holds(page, "<figcaption>Of my own</figcaption>"));
}

// Without a caption of its own a picture has its file's name, as of_my_own.png has.
TEST(ReviewPage, EveryStandardPictureHasACaption) {
  for (const viz::PictureKind& kind : viz::PictureKinds()) {
    std::string name = kind.name;
    ReviewContent content = MadeUpContent();
    content.pictures = {{name + ".png", SmallPng()}};
    std::replace(name.begin(), name.end(), '_', ' ');
    name[0] = static_cast<char>(std::toupper(name[0]));
    const std::string page = PageOf(content);
    EXPECT_TRUE(Holds(page, "<figcaption>"));
    EXPECT_FALSE(Holds(page, "<figcaption>" + name + "</figcaption>")) << name;
  }
}

TEST(ReviewPage, TheSameContentGivesTheSameBytes) {
  EXPECT_EQ(PageOf(MadeUpContent()), PageOf(MadeUpContent()));
}

TEST(ReviewPage, WithoutVtkJsItSaysSoAndHowToGetIt) {
  ReviewContent content = MadeUpContent();
  content.vtk_js = {};
  const std::string page = PageOf(content);
  EXPECT_TRUE(Holds(page, "built without vtk.js"));
  EXPECT_TRUE(Holds(page, "&#39;bash bootstrap build&#39;") ||
              Holds(page, "'bash bootstrap build'"));
  EXPECT_TRUE(Holds(page, "id=\"scene-data\">null</script>"));
  EXPECT_TRUE(Holds(page, "data:image/png"));
}

// What is lost or of another kind than results.json promises is named with its place.
TEST(ReviewPage, ResultsOfAnotherShapeAreBadInput) {
  using nlohmann::ordered_json;
  const ordered_json missing = ordered_json::value_t::discarded;
  for (const auto& [place, value, named] :
       {std::tuple<std::string, ordered_json, std::string>{"/tables", missing,
                                                           "tables: is missing"},
        {"/tables", 7, "tables: a list is wanted, found 7"},
        {"/tables/0", "text", "tables[0]: an object is wanted"},
        {"/tables/0/id", missing, "tables[0].id: is missing"},
        {"/tables/0/rows", missing, "tables[0].rows: is missing"},
        {"/tables/0/columns", missing, "tables[0].columns: is missing"},
        {"/tables/0/columns/1/unit", 1, "tables[0].columns[1].unit: a text is wanted, found 1"},
        {"/tables/1/rows/0", {"alone"}, "tables[1].rows[0]: 2 cells, one per column, are wanted"},
        {"/tables/0/rows/1/0", 5, "tables[0].rows[1][0]: an object is wanted, found 5"},
        {"/tables/0/rows/1/1/printed", missing, "tables[0].rows[1][1].printed: is missing"},
        {"/quantities", missing, "quantities: is missing"},
        {"/quantities/0/label", nullptr, "quantities[0].label: a text is wanted, found null"},
        {"/document", "Ada", "document: an object is wanted"},
        {"/decision", missing, "decision: is missing"},
        {"/verdict", true, "verdict: a text is wanted, found true"}}) {
    ReviewContent content = MadeUpContent();
    const ordered_json::json_pointer pointer(place);
    if (value.is_discarded())
      content.results.at(pointer.parent_pointer()).erase(pointer.back());
    else
      content.results.at(pointer) = value;
    const auto page = viz::ReviewPage(content);
    ASSERT_FALSE(page) << place;
    EXPECT_EQ(page.error().kind, ErrorKind::kBadInput);
    EXPECT_TRUE(Holds(page.error().message, "results.json: " + named)) << page.error().message;
    EXPECT_TRUE(Holds(page.error().message, "run 'telestrain report' again"));
  }
}

}  // namespace
}  // namespace telestrain::review_test
