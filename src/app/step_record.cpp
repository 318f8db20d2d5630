#include "app/step_record.h"

#include <sys/stat.h>

#include <algorithm>
#include <set>

#include "app/program_record.h"
#include "app/results_lock.h"
#include "base/files.h"
#include "base/json_file.h"
#include "report/audit/audit_line.h"
#include "report/audit/step_order.h"
#include "report/audit/trail_files.h"
#include "report/declared_time.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTrail = "audit.jsonl";

Json FileRecord(const char* where, const std::string& path, const std::string& bytes) {
  return {{"of", where}, {"path", path}, {"bytes", bytes.size()}, {"sha256", Sha256Hex(bytes)}};
}

// The path inside the results folder; empty when it lies outside.
std::string InsideResults(const fs::path& results, const fs::path& path) {
  std::error_code code;
  const std::string inside =
      fs::weakly_canonical(path, code).lexically_relative(fs::weakly_canonical(results, code));
  return inside.empty() || inside.starts_with("..") ? "" : inside;
}

Status AddFiles(const StepRecord& step, const fs::path& results, const Json& inputs_json,
                Json& inputs) {
  std::map<std::string, Json> known;
  for (const Json& file : ListAt(inputs_json, "/files")) known[TextAt(file, "/path")] = file;
  for (const std::string& name : step.session_inputs)
    if (const auto file = known.find(name); file != known.end()) {
      inputs.push_back({{"of", "session"}});
      inputs.back().update(file->second);
    }
  std::error_code code;
  for (const std::string& name : step.inputs) {
    if (!fs::exists(results / name, code)) continue;
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes,
                                ReadFile(results / name, kMostResultBytes));
    inputs.push_back(FileRecord("results", name, bytes));
  }
  for (const fs::path& path : step.inputs_elsewhere) {
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path, kMostResultBytes));
    inputs.push_back(FileRecord("elsewhere", path.filename().string(), bytes));
  }
  return {};
}

Result<Json> OutputsOf(const StepRecord& step, const fs::path& results) {
  const fs::path folder = step.outputs_folder.empty() ? results : step.outputs_folder;
  Json outputs = Json::array();
  std::error_code code;
  for (const std::string& name : step.outputs) {
    if (!fs::exists(folder / name, code)) continue;
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(folder / name, kMostResultBytes));
    const std::string inside = InsideResults(results, folder / name);
    outputs.push_back(inside.empty() ? FileRecord("elsewhere", name, bytes)
                                     : FileRecord("results", inside, bytes));
  }
  return outputs;
}

Result<AuditTrail> OpenTrail(const fs::path& results) {
  auto trail = AuditTrail::Open(results / kTrail);
  if (trail) return trail;
  return BadInput(trail.error().message +
                  "; what was done in this folder can no longer be told: keep it and use another "
                  "--out folder");
}

Result<Json> ReadInputs(const fs::path& results) {
  return ReadJson(results / "inputs.json", "telestrain.inputs/1", "telestrain detect");
}

// What decides about the outputs of a step.
Result<Json> BodyOf(const StepRecord& step, const fs::path& results, const Json& inputs_json) {
  Json inputs = Json::array();
  TELESTRAIN_RETURN_IF_ERROR(AddFiles(step, results, inputs_json, inputs));
  return Json{
      {"program", ProgramRecord()}, {"options", step.options}, {"inputs", std::move(inputs)}};
}

// Pictures of several renderings lie side by side; any other step makes its files anew.
bool SharesItsFolder(const StepRecord& step) { return step.type == std::string("render"); }

// The files of the entry lie in the results folder as it made them, and none that it did not make.
bool FilesAreAsMade(const std::vector<AuditEntry>& entries, std::size_t index,
                    const StepRecord& step, const fs::path& results) {
  std::set<std::string> made;
  for (const Json& file : ListAt(entries[index].body, "/outputs")) {
    if (TextAt(file, "/of") != "results") return false;
    made.insert(TextAt(file, "/path"));
  }
  const auto entry = entries.begin() + static_cast<std::ptrdiff_t>(index);
  const std::vector<AuditEntry> alone(entry, SharesItsFolder(step) ? entry + 1 : entries.end());
  const auto files = LatestOutputs(alone);
  std::error_code code;
  for (const std::string& path : made)
    if (!fs::exists(results / path, code) || !IsAsMade(results / path, path, files.at(path)))
      return false;
  const auto of_all = LatestOutputs(entries);
  return std::none_of(step.outputs.begin(), step.outputs.end(), [&](const std::string& name) {
    if (made.contains(name) || !fs::exists(results / name, code)) return false;
    const auto other = of_all.find(name);
    return !SharesItsFolder(step) || other == of_all.end() ||
           !IsAsMade(results / name, name, other->second);
  });
}

// Whether the entry tells of this step with what is there now.
Result<bool> TellsOf(const std::vector<AuditEntry>& entries, std::size_t index,
                     const StepRecord& step, const fs::path& results) {
  if (!FilesAreAsMade(entries, index, step, results)) return false;
  TELESTRAIN_ASSIGN_OR_RETURN(const Json inputs_json, ReadInputs(results));
  // A report tells of the declared time.
  if (step.type == "report" &&
      entries[index].time != DeclaredTime(EntryAt(inputs_json, "/document")))
    return false;
  TELESTRAIN_ASSIGN_OR_RETURN(const Json body, BodyOf(step, results, inputs_json));
  return std::all_of(body.items().begin(), body.items().end(), [&](const auto& item) {
    return CanonicalJson(item.value()) ==
           CanonicalJson(EntryAt(entries[index].body, "/" + item.key()));
  });
}

}  // namespace

Status CheckTrail(const fs::path& results) {
  const auto trail = OpenTrail(results);
  return trail ? Status() : Status(trail.error());
}

Status RecordStep(const fs::path& results, const StepRecord& step) {
  TELESTRAIN_ASSIGN_OR_RETURN(const Json inputs_json, ReadInputs(results));
  TELESTRAIN_ASSIGN_OR_RETURN(Json body, BodyOf(step, results, inputs_json));
  TELESTRAIN_ASSIGN_OR_RETURN(body["outputs"], OutputsOf(step, results));
  if (step.type == "open") body["session"] = TextAt(inputs_json, "/title");
  TELESTRAIN_ASSIGN_OR_RETURN(const ResultsLock lock, ResultsLock::Take(results));
  TELESTRAIN_ASSIGN_OR_RETURN(AuditTrail trail, OpenTrail(results));
  if (IsRecorded(trail, step.type, body)) return {};
  TELESTRAIN_RETURN_IF_ERROR(
      trail.Append(step.type, body, DeclaredTime(EntryAt(inputs_json, "/document"))));
  return trail.Replace();
}

Result<bool> IsDone(const fs::path& results, const StepRecord& step) {
  std::error_code code;
  if (!fs::exists(results / "inputs.json", code)) return false;
  TELESTRAIN_ASSIGN_OR_RETURN(const AuditTrail trail, OpenTrail(results));
  const auto& entries = trail.entries();
  for (std::size_t index = entries.size(); index-- > 0;) {
    if (entries[index].type != step.type) continue;
    // A report that is there was not taken away: the pictures that were drawn since are not in it.
    if (step.type != "report" && IsSuperseded(entries, index)) return false;
    TELESTRAIN_ASSIGN_OR_RETURN(const bool tells, TellsOf(entries, index, step, results));
    if (tells || !SharesItsFolder(step)) return tells;
  }
  return false;
}

Result<bool> IsKept(const fs::path& results, const StepRecord& step, Console& console) {
  TELESTRAIN_ASSIGN_OR_RETURN(const bool done, IsDone(results, step));
  if (done)
    console.Say(step.type + std::string(11 - std::min<std::size_t>(step.type.size(), 10), ' ') +
                "kept: made from the same inputs, options and program");
  return done;
}

Result<std::vector<std::string>> SessionFiles(const fs::path& results) {
  TELESTRAIN_ASSIGN_OR_RETURN(const Json inputs_json, ReadInputs(results));
  std::vector<std::string> names;
  for (const Json& file : ListAt(inputs_json, "/files")) names.push_back(TextAt(file, "/path"));
  return names;
}

std::vector<std::string> TargetFiles(const Session& session) {
  std::vector<std::string> names{"session.toml", "calibration.csv", "ruler.csv"};
  if (!session.corners_are_given)
    for (const CalibrationImage& image : session.calibration_images) names.push_back(image.image);
  names.insert(names.end(), session.ruler_images.begin(), session.ruler_images.end());
  return names;
}

std::vector<std::string> PipeFiles(const Session& session) {
  std::vector<std::string> names{"session.toml", "pipe.csv"};
  for (const PipeState& state : session.pipe_states) names.push_back(state.image);
  return names;
}

StepRecord SceneRecord(const std::string& type, const fs::path& results) {
  StepRecord record;
  record.type = type;
  record.inputs = {"inputs.json", "calibration.json", "residuals.csv", "ruler.json", "strain.json"};
  std::vector<std::string> surfaces;
  std::error_code code;
  for (fs::directory_iterator entry(results, code), end; !code && entry != end;
       entry.increment(code))
    if (entry->path().extension() == ".vtp") surfaces.push_back(entry->path().filename().string());
  std::sort(surfaces.begin(), surfaces.end());
  record.inputs.insert(record.inputs.end(), surfaces.begin(), surfaces.end());
  return record;
}

std::vector<fs::path> IfGiven(const fs::path& path) {
  return path.empty() ? std::vector<fs::path>{} : std::vector{path};
}

std::string RecordedPlace(const fs::path& results, const fs::path& out) {
  if (out.empty()) return "";
  const std::string inside = InsideResults(results, out);
  const fs::path name = out.has_filename() ? out.filename() : out.parent_path().filename();
  return inside.empty() ? name.string() : "RESULTS/" + inside;
}

WrittenFiles::WrittenFiles(fs::path folder) : folder_(std::move(folder)), before_(Stamps()) {}

std::map<std::string, WrittenFiles::Stamp> WrittenFiles::Stamps() const {
  std::map<std::string, Stamp> stamps;
  std::error_code code;
  for (fs::directory_iterator entry(folder_, code), end; !code && entry != end;
       entry.increment(code)) {
    struct stat file {};
    if (::stat(entry->path().c_str(), &file) != 0 || !S_ISREG(file.st_mode)) continue;
    stamps[entry->path().filename().string()] = {
        file.st_ino, file.st_mtim.tv_sec * 1000000000LL + file.st_mtim.tv_nsec};
  }
  return stamps;
}

std::vector<std::string> WrittenFiles::Names() const {
  std::vector<std::string> names;
  for (const auto& [name, stamp] : Stamps())
    if (const auto before = before_.find(name); before == before_.end() || before->second != stamp)
      names.push_back(name);
  return names;
}

}  // namespace telestrain
