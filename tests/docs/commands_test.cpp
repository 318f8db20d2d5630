#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "docs/document.h"
#include "docs/document_shell.h"
#include "unit/base/scratch_folder.h"

namespace telestrain {
namespace {

using namespace testing_support;
namespace fs = std::filesystem;

const fs::path kProject = TELESTRAIN_SOURCE_DIR;

std::string Place(const Document& document, int line) {
  return fs::relative(document.path, kProject).string() + ":" + std::to_string(line);
}

// Every command of every document, in the document's order, in a folder for each document.
class Commands : public testing::TestWithParam<fs::path> {
 protected:
  static const fs::path& Scratch() {
    static const ScratchFolder scratch("telestrain_documents_");
    return scratch.path();
  }
};

TEST_P(Commands, DoAsTheDocumentShows) {
  const Document document = ReadDocument(GetParam());
  const DocumentShell shell(Scratch() / "document");
  for (const ShownCommand& command : document.commands) {
    const ProgramRun run = shell.Run(command.command);
    ASSERT_EQ(run.exit_code, command.exit_code)
        << Place(document, command.line) << ": " << command.command << "\n"
        << run.out;
    if (command.output.empty()) continue;
    EXPECT_TRUE(DescribesOutput(command.output, run.out))
        << Place(document, command.line) << ": " << command.command << "\nprints\n"
        << run.out;
  }
}

std::vector<fs::path> DocumentsWithCommands() {
  std::vector<fs::path> paths;
  for (const fs::path& path : DocumentPaths(kProject))
    if (!ReadDocument(path).commands.empty()) paths.push_back(path);
  return paths;
}

std::string NameOf(const testing::TestParamInfo<fs::path>& info) {
  std::string name = fs::relative(info.param, kProject).string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Of, Commands, testing::ValuesIn(DocumentsWithCommands()), NameOf);

TEST(RunPage, NamesEveryFileThatRunWrites) {
  const ScratchFolder scratch("telestrain_run_files_");
  const DocumentShell shell(scratch.path() / "document");
  ASSERT_EQ(shell.Run(DocumentShell::SharedCommand()).exit_code, 0);
  const std::string page = ReadDocument(kProject / "src/app/pages/run.md").text;
  int files = 0;
  for (const auto& entry :
       fs::recursive_directory_iterator(scratch.path() / "document" / "results")) {
    if (!entry.is_regular_file()) continue;
    std::string name =
        fs::relative(entry.path(), scratch.path() / "document" / "results").generic_string();
    if (name.ends_with(".vtp")) name = std::regex_replace(name, std::regex("[0-9]"), "N");
    EXPECT_NE(page.find("`" + name + "`"), std::string::npos) << name;
    ++files;
  }
  EXPECT_GT(files, 20);
}

TEST(UntestedCommands, SayWhyAndAreFew) {
  std::size_t tested = 0, untested = 0;
  for (const fs::path& path : DocumentPaths(kProject)) {
    const Document document = ReadDocument(path);
    tested += document.commands.size();
    for (const UntestedBlock& block : document.untested) {
      untested += block.commands.size();
      EXPECT_GT(block.reason.size(), 10U) << Place(document, block.line);
      EXPECT_FALSE(block.commands.empty()) << Place(document, block.line) << ": holds no command";
    }
  }
  RecordProperty("commands_run", static_cast<int>(tested));
  RecordProperty("commands_not_run", static_cast<int>(untested));
  std::printf("%zu commands run, %zu not run, each with its reason\n", tested, untested);
  EXPECT_LT(5 * untested, tested);
}

}  // namespace
}  // namespace telestrain
