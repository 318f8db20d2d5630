#include "docs/document_shell.h"

#include <cstdlib>

#include "unit/base/scratch_folder.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

struct SharedResults {
  ScratchFolder scratch{"telestrain_shared_results_"};
  ProgramRun run;
  SharedResults() { run = DocumentShell(Folder()).Run(DocumentShell::SharedCommand() + " "); }
  fs::path Folder() const { return scratch.path() / "document"; }
};

const SharedResults& Shared() {
  static const SharedResults shared;
  return shared;
}

}  // namespace

DocumentShell::DocumentShell(const fs::path& folder) : folder_(folder) {
  fs::remove_all(folder_);
  fs::create_directories(folder_ / "build");
  fs::create_directory_symlink(TelestrainPath().parent_path(), folder_ / "build/release");
  const fs::path sources = SmallSession().parent_path().parent_path();
  for (const char* name : {"data", "templates", "tests"})
    fs::create_directory_symlink(sources / name, folder_ / name);
}

const std::string& DocumentShell::SharedCommand() {
  static const std::string command = "telestrain run data/small_session --out results";
  return command;
}

ProgramRun DocumentShell::Run(const std::string& command) const {
  const std::string folder = "build/release/";
  const bool in_full = command.starts_with(folder);
  if (command.substr(in_full ? folder.size() : 0) != SharedCommand()) return RunByBash(command);
  const SharedResults& shared = Shared();
  if (shared.run.exit_code == 0)
    fs::copy(shared.Folder() / "results", folder_ / "results", fs::copy_options::recursive);
  return shared.run;
}

ProgramRun DocumentShell::RunByBash(const std::string& command) const {
  const char* path = std::getenv("PATH");
  Surroundings where{folder_, {}, false};
  where.environment = {{"HOME", folder_.string()},
                       {"LC_ALL", "C.UTF-8"},
                       {"PATH", TelestrainPath().parent_path().string() + ":" + (path ? path : "")},
                       {"TELESTRAIN_INSTRUMENT_LOG", std::nullopt},
                       {"TELESTRAIN_INSTRUMENT_KEY", std::nullopt},
                       {"TELESTRAIN_TRUST", std::nullopt}};
  return RunProgram({"/bin/bash", "-c", "exec 2>&1; " + command}, where);
}

}  // namespace telestrain::testing_support
