// bash itself completes; what it offers is what the tables say and nothing else.
#include "app/pages/completion.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <set>

#include "app/pages/offer.h"
#include "app/program.h"
#include "cli/program_run.h"
#include "unit/base/scratch_folder.h"
#include "viz/desk/desk_arguments.h"

namespace telestrain::testing_support {
namespace {

using Words = std::vector<std::string>;

std::set<std::string> SetOf(const Words& words) { return {words.begin(), words.end()}; }

// Asks one bash for many lines, as each start of it takes its time.
class Bash {
 public:
  explicit Bash(const CLI::App& program) {
    std::ofstream(folder_.path() / "completion.bash") << BashCompletion(program);
    script_ << "source completion.bash\n"
            << "ask() { COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); COMPREPLY=()\n"
            << "  \"$(complete -p \"$1\" | sed 's/.*-F \\([^ ]*\\).*/\\1/')\"\n"
            << "  for word in \"${COMPREPLY[@]}\"; do printf '%s\\n' \"$word\"; done; echo .; }\n";
  }
  // The last word is the one that is completed.
  void Ask(const Words& line) {
    script_ << "ask";
    for (const std::string& word : line) script_ << " " << ShellQuoted(word);
    script_ << "\n";
  }
  // What was offered for every line.
  std::vector<std::set<std::string>> Answers() {
    std::ofstream(folder_.path() / "ask.bash") << script_.str();
    const ProgramRun run =
        RunProgram({TELESTRAIN_BASH, "--norc", "ask.bash"}, {folder_.path(), {}});
    EXPECT_EQ(run.err, "");
    std::vector<std::set<std::string>> answers(1);
    std::istringstream stream(run.out);
    for (std::string line; std::getline(stream, line);)
      if (line == ".")
        answers.emplace_back();
      else
        answers.back().insert(line);
    answers.pop_back();
    return answers;
  }

 private:
  ScratchFolder folder_{"completion"};
  std::ostringstream script_;
};

std::set<std::string> Offered(const CLI::App& program, const Words& line) {
  Bash bash(program);
  bash.Ask(line);
  const auto answers = bash.Answers();
  return answers.size() == 1 ? answers.front() : std::set<std::string>{"no answer"};
}

void AddApps(const CLI::App& app, const Words& path,
             std::vector<std::pair<Words, const CLI::App*>>* apps) {
  apps->push_back({path, &app});
  for (const CLI::App* below : app.get_subcommands({})) {
    Words deeper = path;
    deeper.push_back(below->get_name());
    AddApps(*below, deeper, apps);
  }
}

// The program, its verbs and theirs, by the words that lead to them.
std::vector<std::pair<Words, const CLI::App*>> AllApps(const CLI::App& program) {
  std::vector<std::pair<Words, const CLI::App*>> apps;
  AddApps(program, {program.get_name()}, &apps);
  return apps;
}

Words With(Words line, std::initializer_list<std::string> more) {
  line.insert(line.end(), more);
  return line;
}

TEST(Completion, OffersTheOptionsOfEveryVerbAndNoOthers) {
  Program program;
  Bash bash(program.app());
  const auto apps = AllApps(program.app());
  for (const auto& [path, app] : apps) bash.Ask(With(path, {"-"}));
  const auto answers = bash.Answers();
  ASSERT_EQ(answers.size(), apps.size());
  for (std::size_t i = 0; i < apps.size(); ++i) {
    std::set<std::string> names;
    for (const OptionFacts& option : OptionsOf(*apps[i].second))
      if (!option.is_argument) names.insert(option.names.begin(), option.names.end());
    EXPECT_EQ(answers[i], names) << apps[i].first.back();
  }
}

TEST(Completion, OffersTheValuesOfAListAndNoOthers) {
  Program program;
  Bash bash(program.app());
  std::vector<std::set<std::string>> wanted;
  for (const auto& [path, app] : AllApps(program.app()))
    for (const OptionFacts& option : OptionsOf(*app)) {
      if (option.is_argument || option.choices.empty()) continue;
      wanted.push_back(SetOf(option.choices));
      bash.Ask(With(path, {option.names.back(), ""}));
      wanted.push_back(SetOf(option.choices));
      bash.Ask(With(path, {option.names.back(), "=", ""}));  // as bash splits --name=
    }
  EXPECT_GE(wanted.size(), 20u);
  EXPECT_EQ(bash.Answers(), wanted);
}

TEST(Completion, OffersVerbsOnlyWhereOneMayStand) {
  Program program;
  EXPECT_EQ(Offered(program.app(), {"telestrain", ""}), SetOf(program.Verbs()));
  EXPECT_EQ(Offered(program.app(), {"telestrain", "--instrument-log", "x.jsonl", "cali"}),
            SetOf({"calibrate"}));
  EXPECT_EQ(Offered(program.app(), {"telestrain", "audit", ""}),
            SetOf({"verify", "replay", "show"}));
  EXPECT_EQ(Offered(program.app(), {"telestrain", "run", "no such folder/cal"}), SetOf({}));
}

class CompletionOfFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(files_ / "folder one");
    std::ofstream(files_ / "file") << "x";
  }
  std::set<std::string> After(Words line) {
    line.push_back((files_ / "f").string());
    return Offered(program_.app(), line);
  }
  Program program_;
  ScratchFolder scratch_{"completed"};
  const std::filesystem::path files_ = scratch_.path() / "files";
  const std::string folder_ = (files_ / "folder one").string(), file_ = (files_ / "file").string();
};

TEST_F(CompletionOfFiles, FoldersAreOfferedForFolders) {
  EXPECT_EQ(After({"telestrain", "run"}), SetOf({folder_}));
  EXPECT_EQ(After({"telestrain", "run", "--out"}), SetOf({folder_}));
  EXPECT_EQ(After({"telestrain", "run", "--board-warp"}),
            SetOf({folder_}));  // a switch takes no value
}

TEST_F(CompletionOfFiles, FilesAndTheFoldersOnTheWayAreOfferedForFiles) {
  EXPECT_EQ(After({"telestrain", "run", "session", "--corners"}), SetOf({folder_, file_}));
  EXPECT_EQ(After({"telestrain", "sign"}), SetOf({folder_, file_}));
  EXPECT_EQ(After({"telestrain", "correlate", "a.png", "b.png", "c.png"}), SetOf({folder_, file_}));
  EXPECT_EQ(After({"telestrain", "audit", "verify"}), SetOf({folder_, file_}));
}

TEST_F(CompletionOfFiles, NothingIsOfferedForANumberOrBehindTheLastArgument) {
  EXPECT_EQ(After({"telestrain", "run", "session", "--step-px"}), SetOf({}));
  EXPECT_EQ(After({"telestrain", "run", "session"}), SetOf({}));
}

TEST(Completion, GoesOnAfterTheCommaOfAList) {
  Program program;
  EXPECT_EQ(Offered(program.app(), {"telestrain", "export", "results", "--format", "glb,p"}),
            SetOf({"glb,paraview", "glb,ply"}));
}

TEST(Completion, OfTheViewerIsItsOwn) {
  CLI::App view;
  DeskArguments arguments;
  arguments.AddTo(view);
  EXPECT_EQ(Offered(view, {"telestrain-view", "--l"}), SetOf({"--layers"}));
}

void ExpectParses(const std::string& shell, const std::string& text, const std::string& file) {
  if (shell.empty()) GTEST_SKIP() << file << ": the shell is not installed";
  const ScratchFolder folder("completion_of_shell");
  std::ofstream(folder.path() / file) << text;
  const ProgramRun run = RunProgram({shell, "-n", file}, {folder.path(), {}});
  EXPECT_EQ(run.out + run.err, "");
  EXPECT_EQ(run.exit_code, 0);
}

TEST(Completion, ZshReadsItsOwn) {
  ExpectParses(TELESTRAIN_ZSH, ZshCompletion(Program().app()), "_telestrain");
}

TEST(Completion, FishReadsItsOwn) {
  ExpectParses(TELESTRAIN_FISH, FishCompletion(Program().app()), "telestrain.fish");
}

// Every option by its name, whatever a shell is there.
TEST(Completion, OfZshAndFishNamesEveryOption) {
  Program program;
  const std::string zsh = ZshCompletion(program.app()), fish = FishCompletion(program.app());
  for (const auto& [path, app] : AllApps(program.app()))
    for (const OptionFacts& option : OptionsOf(*app)) {
      if (option.is_argument) continue;
      const std::string name = option.names.back();
      EXPECT_NE(zsh.find(name), std::string::npos) << name;
      EXPECT_NE(fish.find(" -l " + name.substr(2) + " "), std::string::npos) << name;
    }
}

}  // namespace
}  // namespace telestrain::testing_support
