#include <CLI/CLI.hpp>
#include <iostream>

#include "app/pages/completion.h"
#include "app/pages/man_page.h"
#include "app/pages/options_markdown.h"
#include "app/program.h"
#include "base/files.h"
#include "viz/desk/desk_arguments.h"

// Run by the build, not installed.
// telestrain_pages --out FOLDER
//   writes man1/*.1 and completions/{bash,zsh,fish}/… of telestrain and telestrain-view
// telestrain_pages --markdown src/app/pages
//   src/app/pages/run.md

namespace telestrain {
namespace {

namespace fs = std::filesystem;

Status Write(const fs::path& file, const std::string& text) {
  std::error_code code;
  fs::create_directories(file.parent_path(), code);
  return WriteFileAtomically(file, text);
}

Status WritePages(const CLI::App& program, const fs::path& folder) {
  const std::string& name = program.get_name();
  for (const auto& [file, text] : ManPages(program, {TELESTRAIN_DATE, TELESTRAIN_VERSION}))
    TELESTRAIN_RETURN_IF_ERROR(Write(folder / "man1" / file, text));
  const fs::path completions = folder / "completions";
  TELESTRAIN_RETURN_IF_ERROR(Write(completions / "bash" / name, BashCompletion(program)));
  TELESTRAIN_RETURN_IF_ERROR(Write(completions / "zsh" / ("_" + name), ZshCompletion(program)));
  return Write(completions / "fish" / (name + ".fish"), FishCompletion(program));
}

Status UpdateMarkdown(const CLI::App& program, const fs::path& folder) {
  for (const CLI::App* verb : program.get_subcommands({})) {
    const fs::path file = folder / (verb->get_name() + ".md");
    if (!fs::exists(file)) continue;
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string page, ReadFile(file, kMostTextBytes));
    const std::string with_options = WithOptions(page, *verb);
    if (with_options.empty())
      return BadInput(file.string() + ": the lines '" + kOptionsBegin + "' and '" + kOptionsEnd +
                      "' are missing; the options go between them");
    if (with_options == page) continue;
    TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(file, with_options));
    std::cout << file.string() << '\n';
  }
  return {};
}

Status Run(const std::string& option, const fs::path& folder) {
  Program program;
  if (option == "--markdown") return UpdateMarkdown(program.app(), folder);
  CLI::App view;
  DeskArguments arguments;
  arguments.AddTo(view);
  TELESTRAIN_RETURN_IF_ERROR(WritePages(program.app(), folder));
  return WritePages(view, folder);
}

}  // namespace
}  // namespace telestrain

int main(int argc, char** argv) {
  const std::string option = argc == 3 ? argv[1] : "";
  if (option != "--out" && option != "--markdown") {
    std::cerr << "usage: telestrain_pages --out FOLDER | --markdown FOLDER\n";
    return 2;
  }
  const telestrain::Status status = telestrain::Run(option, argv[2]);
  if (status) return 0;
  std::cerr << "telestrain_pages: " << status.error().message << '\n';
  return static_cast<int>(status.error().kind);
}
