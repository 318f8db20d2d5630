// Each rule must fail on a planted violation and pass on what looks like one.
#include <gtest/gtest.h>

#include "style/include_rules.h"
#include "style/size_rules.h"
#include "style/text_rules.h"

namespace telestrain::style {
namespace {

std::string Repeat(std::string_view line, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += line;
  return text;
}

TEST(IncludeRules, UpwardIncludeIsFound) {
  const Findings findings =
      CheckIncludeDirection({"src/base/a.cpp", "#include <string>\n#include \"optics/b.h\"\n"});
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0], "src/base/a.cpp:2: base must not include optics");
}

TEST(IncludeRules, DownwardAndOwnIncludesPass) {
  EXPECT_TRUE(CheckIncludeDirection({"src/optics/a.cpp", "#include \"base/b.h\"\n"}).empty());
  EXPECT_TRUE(CheckIncludeDirection({"src/optics/a.cpp", "#include \"optics/b.h\"\n"}).empty());
  EXPECT_TRUE(
      CheckIncludeDirection({"report/a.cpp", "#include \"measurement/decision.h\"\n"}).empty());
  EXPECT_TRUE(CheckIncludeDirection({"tests/unit/a_test.cpp", "#include \"app/b.h\"\n"}).empty());
}

TEST(IncludeRules, ForbiddenPairsAreFoundThoughBelow) {
  for (const char* module : {"calibration", "measurement"}) {
    const std::string text = std::string("#include \"") + module + "/b.h\"\n";
    EXPECT_EQ(CheckIncludeDirection({"src/simulation/a.cpp", text}).size(), 1u) << module;
  }
  for (const char* module : {"calibration", "correlation"}) {
    const std::string text = std::string("#include \"") + module + "/b.h\"\n";
    EXPECT_EQ(CheckIncludeDirection({"viz/a.cpp", text}).size(), 1u) << module;
    EXPECT_EQ(CheckIncludeDirection({"report/a.cpp", text}).size(), 1u) << module;
  }
  EXPECT_EQ(CheckIncludeDirection({"report/a.cpp", "#include \"viz/b.h\"\n"}).size(), 1u);
}

TEST(IncludeRules, IncludeWithoutModuleIsFound) {
  EXPECT_EQ(CheckIncludeDirection({"src/base/a.cpp", "#include \"b.h\"\n"}).size(), 1u);
  EXPECT_EQ(CheckIncludeDirection({"src/base/a.cpp", "#include \"elsewhere/b.h\"\n"}).size(), 1u);
}

TEST(IncludeRules, HeavyHeaderIsFoundInHeadersAndInWrongModules) {
  EXPECT_EQ(CheckHeavyHeaders({"src/target/a.h", "#include <opencv2/core.hpp>\n"}).size(), 1u);
  EXPECT_EQ(CheckHeavyHeaders({"src/optics/a.cpp", "#include <ceres/ceres.h>\n"}).size(), 1u);
  EXPECT_EQ(CheckHeavyHeaders({"report/a.cpp", "#include <vtkActor.h>\n"}).size(), 1u);
  EXPECT_TRUE(CheckHeavyHeaders({"src/target/a.cpp", "#include <opencv2/core.hpp>\n"}).empty());
  EXPECT_TRUE(CheckHeavyHeaders({"viz/a.cpp", "#include <vtkActor.h>\n"}).empty());
}

TEST(IncludeRules, PrivateHeadersMayBeHeavyButStayInside) {
  EXPECT_TRUE(CheckHeavyHeaders({"viz/canvas.h", "#include <vtkActor.h>\n"}).empty());
  EXPECT_TRUE(CheckHeavyHeaders({"src/calibration/board_residual.h", "#include <ceres/ceres.h>\n"})
                  .empty());
  EXPECT_TRUE(CheckIncludeDirection({"viz/a.cpp", "#include \"viz/canvas.h\"\n"}).empty());
  EXPECT_EQ(CheckIncludeDirection({"src/app/a.cpp", "#include \"viz/canvas.h\"\n"}).size(), 1u);
}

TEST(SizeRules, LongFileIsFound) {
  EXPECT_TRUE(CheckFileSize({"src/base/a.cpp", Repeat("int a;\n", 400)}).empty());
  EXPECT_EQ(CheckFileSize({"src/base/a.cpp", Repeat("int a;\n", 401)}).size(), 1u);
}

TEST(SizeRules, LongFunctionIsFound) {
  const std::string body = Repeat("  Step();\n", 58);
  EXPECT_TRUE(CheckFunctions({"a.cpp", "void F() {\n" + body + "}\n"}).empty());
  EXPECT_EQ(CheckFunctions({"a.cpp", "void F() {\n" + body + "  Step();\n}\n"}).size(), 1u);
}

TEST(SizeRules, DeepNestingIsFound) {
  const std::string three = "void F() {\n for (;;) {\n if (a) {\n while (b) {\n }\n }\n }\n}\n";
  const std::string four =
      "void F() {\n for (;;) {\n if (a) {\n } else {\n do {\n try {\n } catch (...) {\n }\n }\n "
      "while (b);\n }\n }\n}\n";
  EXPECT_TRUE(CheckFunctions({"a.cpp", three}).empty());
  EXPECT_EQ(CheckFunctions({"a.cpp", four}).size(), 1u);
}

TEST(SizeRules, FunctionsAreSeenInEveryDress) {
  const std::string text = R"(namespace a {
template <class T>
class Grid : public Base<T> {
 public:
  explicit Grid(int rows) : rows_{rows}, name_("{") {
    Fill();
  }
  int rows() const { return rows_; }
  auto Row(int i) const -> std::vector<T> {
    return {};
  }

 private:
  int rows_ = 0;
  std::vector<int> sizes_{1, 2};
};
constexpr std::array kTable = {Pair{1, 2}, Pair{3, 4}};
bool operator==(const A& a, const B& b) noexcept {
  return true;
}
void Long(
    int first,
    int second) {
  // } a brace in a comment
  Call([&](int x) {
    if (x) {
      Print("}", '}', 1'000);
    }
  });
}
}
)";
  const auto functions = FunctionsOf(text);
  ASSERT_EQ(functions.size(), 5u);
  EXPECT_EQ(functions[0].lines, 3);
  EXPECT_EQ(functions[0].first_line, 5);
  EXPECT_EQ(functions[1].lines, 1);
  EXPECT_EQ(functions[2].lines, 3);
  EXPECT_EQ(functions[3].lines, 3);
  EXPECT_EQ(functions[4].lines, 10);
  EXPECT_EQ(functions[4].first_line, 21);
  EXPECT_EQ(functions[4].nesting, 1);
}

TEST(SizeRules, RawStringsAndPreprocessorLinesAreNoCode) {
  const std::string text =
      "#define OPEN {\nconst char* k = R\"x(void F() {)\" )x\";\nint G() {\n  return 1;\n}\n";
  const auto functions = FunctionsOf(text);
  ASSERT_EQ(functions.size(), 1u);
  EXPECT_EQ(functions[0].first_line, 3);
}

TEST(TextRules, BlanksAreFound) {
  EXPECT_EQ(CheckBlanks({"a.cpp", "int a;\tint b;\n"}).size(), 1u);
  EXPECT_EQ(CheckBlanks({"a.cpp", "int a; \n"}).size(), 1u);
  EXPECT_EQ(CheckBlanks({"a.cpp", "int a;\r\n"}).size(), 1u);
  EXPECT_EQ(CheckBlanks({"a.cpp", "int a;"}).size(), 1u);
  EXPECT_EQ(CheckBlanks({"a.cpp", "int a;\n\n"}).size(), 1u);
  EXPECT_TRUE(CheckBlanks({"a.cpp", "int a;\n"}).empty());
}

TEST(TextRules, NotesOfUnfinishedWorkAreFound) {
  const std::string words[] = {std::string("TO") + "DO", std::string("FIX") + "ME",
                               std::string("XX") + "X"};
  for (const std::string& word : words) {
    EXPECT_EQ(CheckBannedWords({"a.cpp", "// " + word + ": later\n"}).size(), 1u);
    EXPECT_TRUE(CheckBannedWords({"a.cpp", "name." + word + "X\n"}).empty());
  }
}

TEST(TextRules, MachinePathsAreFound) {
  const std::string root = std::string("/ho") + "me/";
  EXPECT_EQ(CheckMachinePaths({"a.md", "see " + root + "me/a\n"}).size(), 1u);
  EXPECT_EQ(CheckMachinePaths({"a.cpp", "Open(\"" + root + "me\");\n"}).size(), 1u);
  EXPECT_TRUE(CheckMachinePaths({"a.cpp", "Open(folder + \"build" + root + "a\");\n"}).empty());
}

TEST(TextRules, SilentHeadersAreFound) {
  EXPECT_TRUE(CheckHeaderComment({"a.h", "#pragma once\n\n// Adds.\nint Add();\n"}).empty());
  EXPECT_EQ(CheckHeaderComment({"a.h", "#pragma once\nint Add();\n}  // namespace a\n"}).size(),
            1u);
  EXPECT_EQ(CheckHeaderComment({"a.h", "// Adds.\nint Add();\n"}).size(), 1u);
}

TEST(TextRules, CatchAllNamesAreFound) {
  EXPECT_EQ(CheckFileName("src/base/string_utils.h").size(), 1u);
  EXPECT_EQ(CheckFileName("src/base/common.h").size(), 1u);
  EXPECT_TRUE(CheckFileName("src/base/files.h").empty());
}

TEST(TextRules, UnlistedSourcesAreFound) {
  const SourceFile module_list = {"src/base/CMakeLists.txt", "SOURCES a.cpp deep/b.cpp)\n"};
  const SourceFile test_list = {"tests/unit/base/CMakeLists.txt", "SOURCES a_test.cpp\n"};
  EXPECT_TRUE(CheckListedInCMake({module_list, {"src/base/a.cpp", ""}}).empty());
  EXPECT_TRUE(CheckListedInCMake({module_list, {"src/base/deep/b.cpp", ""}}).empty());
  EXPECT_TRUE(CheckListedInCMake({test_list, {"tests/unit/base/a_test.cpp", ""}}).empty());
  EXPECT_EQ(CheckListedInCMake({module_list, {"src/base/ba.cpp", ""}}).size(), 1u);
  EXPECT_EQ(CheckListedInCMake({module_list, {"src/base/b.cpp", ""}}).size(), 1u);
  EXPECT_EQ(CheckListedInCMake({test_list, {"tests/unit/base/b_test.cpp", ""}}).size(), 1u);
}

TEST(TextRules, StrayTopLevelNamesAreFound) {
  EXPECT_TRUE(CheckTopLevel({"src", "LICENSE", ".ci", ".gitignore"}).empty());
  EXPECT_EQ(CheckTopLevel({"docs"}).size(), 1u);
}

TEST(TextRules, LargeDataIsFound) {
  EXPECT_TRUE(CheckDataSize({{"data/a.png", 4'999'999}}).empty());
  EXPECT_EQ(CheckDataSize({{"data/a.png", 5'000'000}}).size(), 1u);
  EXPECT_EQ(CheckDataSize(std::vector<FileSize>(5, {"data/a.png", 4'000'000})).size(), 1u);
}

}  // namespace
}  // namespace telestrain::style
