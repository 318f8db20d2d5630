#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/console.h"
#include "base/result.h"
#include "session/session.h"

namespace telestrain {

// What a step did, as RESULTS/audit.jsonl keeps it. Nothing of the machine and no clock: the same
// inputs and options give the same entry.
struct StepRecord {
  std::string type;  // the verb, or "open", "results"
  // Every option of the verb with the value that was used, by its flag without the dashes.
  nlohmann::ordered_json options = nlohmann::ordered_json::object();
  std::vector<std::string> session_inputs;              // names in the session, as in inputs.json
  std::vector<std::string> inputs;                      // names in the results folder
  std::vector<std::filesystem::path> inputs_elsewhere;  // recorded by their file names
  std::vector<std::string> outputs;                     // names in `outputs_folder`
  std::filesystem::path outputs_folder = {};            // empty: the results folder
  // Inputs and outputs in the results folder that are not there are left out.
};

// Adds the entry, unless the trail has it already. Fails with kBadInput (the trail or inputs.json
// is damaged, an input elsewhere cannot be read) or kOutputFailed.
Status RecordStep(const std::filesystem::path& results, const StepRecord& record);

// Whether the trail says that the step was done, by this program with these options and inputs, its
// files lie there as it made them, and no step before it in the chain was done since. A report may
// have been signed since, and pictures drawn; a rendering counts that is not the latest. Fails as
// RecordStep does.
Result<bool> IsDone(const std::filesystem::path& results, const StepRecord& record);

// Whether IsDone; then says so in the step's line.
Result<bool> IsKept(const std::filesystem::path& results, const StepRecord& record,
                    Console& console);

// Fails (kBadInput) when the results folder has a damaged trail: known before a step begins.
Status CheckTrail(const std::filesystem::path& results);

// Names of session files that steps read: all that inputs.json lists; those of target and ruler;
// those of the pipe.
Result<std::vector<std::string>> SessionFiles(const std::filesystem::path& results);
std::vector<std::string> TargetFiles(const Session& session);
std::vector<std::string> PipeFiles(const Session& session);

// A record with all files as inputs that a scene is made of.
StepRecord SceneRecord(const std::string& type, const std::filesystem::path& results);

// The path, or nothing when it is empty.
std::vector<std::filesystem::path> IfGiven(const std::filesystem::path& path);

// Where a verb writes, as an option is recorded: "RESULTS/…" inside the results folder, else the
// last name only.
std::string RecordedPlace(const std::filesystem::path& results, const std::filesystem::path& out);

// Which files of a folder are written while the object lives.
class WrittenFiles {
 public:
  explicit WrittenFiles(std::filesystem::path folder);
  std::vector<std::string> Names() const;  // sorted

 private:
  using Stamp = std::pair<unsigned long, long long>;  // inode, ns of the last change
  std::map<std::string, Stamp> Stamps() const;
  std::filesystem::path folder_;
  std::map<std::string, Stamp> before_;
};

}  // namespace telestrain
