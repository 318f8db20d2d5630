#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/command.h"
#include "app/instrument_log.h"

namespace telestrain {

// The command line of telestrain: the options of the program, its verbs and theirs. What the
// options read lies in the commands and in log().
class Program {
 public:
  Program();
  ~Program();

  CLI::App& app() { return *app_; }
  const CLI::App& app() const { return *app_; }
  const InstrumentLog& log() const { return log_; }
  // Sorted as the program's help lists them.
  std::vector<std::string> Verbs() const;
  // The verb that the parsed line asks for; null when it asks for none.
  Command* Chosen() const;

 private:
  std::unique_ptr<CLI::App> app_;
  InstrumentLog log_;
  bool as_json_ = false;
  std::vector<std::unique_ptr<Command>> commands_;
};

}  // namespace telestrain
