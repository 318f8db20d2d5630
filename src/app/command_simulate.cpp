#include <CLI/CLI.hpp>

#include "app/command.h"
#include "app/list_arguments.h"
#include "base/numbers.h"
#include "base/value_names.h"
#include "simulation/virtual_experiment.h"

// telestrain simulate --out SESSION
//   simulate   24 board, 12 ruler and 6 pipe images in session
//   truth      session-truth.json

namespace telestrain {
namespace {

// "PX" for px; "%" says nothing where a value is wanted.
std::string ValueName(std::string unit) {
  if (unit.empty()) return kCount;
  if (unit.front() == '%') unit.replace(0, 1, "PERCENT");
  for (char& c : unit)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return unit;
}

class SimulateCommand : public Command {
 public:
  std::string Name() const override { return "simulate"; }
  std::string Summary() const override {
    return "write a session folder as a virtual instrument would record it, and its truth beside "
           "it";
  }
  std::string Example() const override {
    return "telestrain simulate --out session --seed 7 --noise-gray 1.5";
  }
  void AddOptions(CLI::App& app) override {
    app.add_option("--out", out_, "session folder to write; must not hold a session yet")
        ->type_name(kFolder)
        ->required();
    app.add_option("--truth", truth_, "file for the truth [--out with -truth.json]")
        ->type_name(kFile);
    for (const VirtualExperimentOptionInfo& info : VirtualExperimentOptionTable())
      std::visit([&](auto member) { AddOption(app, info, options_.*member); }, info.member);
    app.add_option("--document", document_,
                   "KEY=TEXT: an entry of [document] in session.toml, as date=2026-01-31; may be "
                   "repeated")
        ->type_name("KEY=TEXT");
  }
  Result<int> Run(Console& console) override {
    TELESTRAIN_RETURN_IF_ERROR(ReadDocument());
    std::filesystem::path folder = std::filesystem::path(out_).lexically_normal();
    if (!folder.has_filename()) folder = folder.parent_path();
    const std::filesystem::path truth = truth_.empty()
                                            ? std::filesystem::path(folder.string() + "-truth.json")
                                            : std::filesystem::path(truth_);
    TELESTRAIN_RETURN_IF_ERROR(WriteVirtualExperiment(options_, folder, truth, console));
    console.Say("simulate   " + std::to_string(2 * options_.poses) + " board, " +
                std::to_string(options_.ruler_images) + " ruler and " +
                std::to_string(options_.pipe_states) + " pipe images in " + folder.string());
    console.Say("truth      " + truth.string());
    return 0;
  }

 private:
  template <typename T>
  static void AddOption(CLI::App& app, const VirtualExperimentOptionInfo& info, T& value) {
    std::string flag = std::string("--") + info.name;
    std::replace(flag.begin(), flag.end(), '_', '-');
    std::string help = info.help;
    if constexpr (!std::is_same_v<T, bool>)
      help += std::string(" (") + info.unit + (*info.unit != '\0' ? ", " : "") +
              FormatShortest(info.minimum) + " to " + FormatShortest(info.maximum) + ")";
    app.add_option(flag, value, help)
        ->type_name(std::is_same_v<T, bool> ? "BOOLEAN:{true,false}" : ValueName(info.unit))
        ->capture_default_str();
  }

  Status ReadDocument() {
    for (const std::string& entry : document_) {
      TELESTRAIN_ASSIGN_OR_RETURN(const auto key_and_text, DocumentEntry(entry));
      options_.document[key_and_text.first] = key_and_text.second;
    }
    return {};
  }

  VirtualExperimentOptions options_;
  std::string out_, truth_;
  std::vector<std::string> document_;
};

}  // namespace

std::unique_ptr<Command> MakeSimulateCommand() { return std::make_unique<SimulateCommand>(); }

}  // namespace telestrain
