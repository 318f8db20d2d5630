#include "app/results_folder.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "app/program_record.h"
#include "base/files.h"
#include "base/json_file.h"
#include "base/utf8.h"
#include "measurement/ruler_acceptance.h"
#include "session/session_record.h"
#include "target/image_file.h"
#include "viz/picture_set.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* kInputsSchema = "telestrain.inputs/1";

const std::vector<std::string>& OutputsOf(Step step) {
  static const std::map<Step, std::vector<std::string>> kOutputs{
      {Step::kDetect, {"corners.vnl", "corner_covariances.csv", "detection.json"}},
      {Step::kCalibrate, {"calibration.json", "residuals.csv", "comparison.json"}},
      {Step::kDiagnose, {"mrcal.json"}},
      {Step::kVerify, {"ruler.csv", "ruler.json"}},
      {Step::kMeasure,
       {"strain.csv", "strain_components.csv", "strain.json", "strain_states.jsonl"}},
      {Step::kRender, {}},  // the standard pictures, whose number depends on the states
      {Step::kReport, {"results.json", "dcc.xml", "report.pdf"}},
      {Step::kReview, {"review.html"}}};
  return kOutputs.at(step);
}

// The state of a file named pipe_000.vtp and so on, as MeasureStep names them.
std::optional<std::size_t> StateOfSurface(const std::string& name) {
  if (!name.starts_with("pipe_") || !name.ends_with(".vtp") || name.size() < 12) return {};
  std::size_t state = 0;
  const char* const end = name.data() + name.size() - 4;
  const auto [stop, failed] = std::from_chars(name.data() + 5, end, state);
  if (failed != std::errc() || stop != end) return {};
  return state;
}

// A signature dictionary says which bytes it covers, in clear.
bool IsSignedPdf(const fs::path& path) {
  if (path.extension() != ".pdf") return false;
  const auto bytes = ReadFile(path, kMostReportBytes);
  return bytes && bytes->find("/ByteRange") != std::string::npos;
}

// What people signed is never taken away: it gets a name that says what became of it.
Status SetAside(const fs::path& path) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string hash, Sha256HexOfFile(path));
  const fs::path aside = path.parent_path() / (path.stem().string() + "_superseded_" +
                                               hash.substr(0, 8) + path.extension().string());
  std::error_code code;
  fs::rename(path, aside, code);
  if (!code) {
    std::cerr << "the signed " << PrintableText(path.filename().string()) << " is now "
              << PrintableText(aside.filename().string()) << '\n';
    return {};
  }
  return OutputFailed(path.string() + ": is signed and cannot be renamed " +
                      aside.filename().string() + ": " + code.message() +
                      "; move it by hand or choose another --out folder");
}

Status Remove(const fs::path& path) {
  if (IsSignedPdf(path)) return SetAside(path);
  std::error_code code;
  if (!fs::exists(fs::symlink_status(path, code))) return {};
  fs::remove(path, code);
  if (!code) return {};
  return CannotRemove(path, "an old result", code.value());
}

Status RemoveNamed(const fs::path& folder, const std::function<bool(const std::string&)>& goes) {
  std::error_code code;
  std::vector<fs::path> names;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end;
       entry.increment(code))
    if (goes(entry->path().filename().string())) names.push_back(entry->path());
  if (code && code != std::errc::no_such_file_or_directory)
    return OutputFailed(folder.string() + ": cannot be looked through for old results: " +
                        code.message() + "; choose another --out folder");
  for (const fs::path& name : names) TELESTRAIN_RETURN_IF_ERROR(Remove(name));
  return {};
}

Json FileJson(const std::string& path, const std::string& bytes) {
  return {{"path", path}, {"bytes", bytes.size()}, {"sha256", Sha256Hex(bytes)}};
}

std::vector<std::string> TableNames(const Session& session) {
  std::vector<std::string> names{"session.toml", "calibration.csv"};
  if (!session.ruler_images.empty()) names.push_back("ruler.csv");
  if (!session.pipe_states.empty()) names.push_back("pipe.csv");
  return names;
}

std::vector<std::string> ImageNames(const Session& session) {
  std::vector<std::string> names;
  if (!session.corners_are_given)
    for (const CalibrationImage& image : session.calibration_images) names.push_back(image.image);
  for (const std::string& image : session.ruler_images) names.push_back(image);
  for (const PipeState& state : session.pipe_states) names.push_back(state.image);
  return names;
}

// Every input file with its hash; fails when an image is not one of this sensor.
Result<Json> FilesJson(const Session& session) {
  Json files = Json::array();
  for (const std::string& name : TableNames(session)) {
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes,
                                ReadFile(session.folder / name, kMostTableBytes));
    files.push_back(FileJson(name, bytes));
  }
  for (const std::string& name : ImageNames(session)) {
    const fs::path path = session.folder / name;
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path, kMostImageBytes));
    TELESTRAIN_RETURN_IF_ERROR(
        CheckImageBytes(path.string(), bytes, session.sensor.width_px, session.sensor.height_px));
    files.push_back(FileJson(name, bytes));
  }
  return files;
}

std::map<std::string, std::string> HashesIn(const Json& files) {
  std::map<std::string, std::string> hashes;
  for (const Json& file : files)
    hashes[file.at("path").get<std::string>()] = file.at("sha256").get<std::string>();
  return hashes;
}

}  // namespace

Status RemoveOutputsFrom(const fs::path& results, Step step) {
  // Diagnosis, ruler and pipe do not depend on each other; everything else follows in order.
  const auto is_branch = [](Step s) { return s >= Step::kDiagnose && s <= Step::kMeasure; };
  for (const Step later : {Step::kDetect, Step::kCalibrate, Step::kDiagnose, Step::kVerify,
                           Step::kMeasure, Step::kRender, Step::kReport, Step::kReview}) {
    if (later < step || (later != step && is_branch(step) && is_branch(later))) continue;
    if (step == Step::kDiagnose && later == Step::kRender) continue;  // pictures do not show it
    for (const std::string& name : OutputsOf(later))
      TELESTRAIN_RETURN_IF_ERROR(Remove(results / name));
    if (later == Step::kMeasure) TELESTRAIN_RETURN_IF_ERROR(RemoveSurfacesFrom(results, 0));
    if (later == Step::kRender)
      TELESTRAIN_RETURN_IF_ERROR(RemoveNamed(results / "pictures", viz::IsStandardPicture));
  }
  return {};
}

Status RemoveSurfacesFrom(const fs::path& results, std::size_t first) {
  return RemoveNamed(results, [&](const std::string& name) {
    const auto state = StateOfSurface(name);
    return state && *state >= first;
  });
}

Status RemoveEndOfMeasure(const fs::path& results) {
  TELESTRAIN_RETURN_IF_ERROR(Remove(results / "strain.json"));
  TELESTRAIN_RETURN_IF_ERROR(Remove(results / "strain_components.csv"));
  return RemoveOutputsFrom(results, Step::kRender);
}

std::vector<std::string> SurfacesIn(const fs::path& results) {
  std::vector<std::string> names;
  std::error_code code;
  for (fs::directory_iterator entry(results, code), end; !code && entry != end;
       entry.increment(code))
    if (const std::string name = entry->path().filename().string(); StateOfSurface(name))
      names.push_back(name);
  std::sort(names.begin(), names.end());
  return names;
}

Result<std::string> InputsText(const Session& session, const fs::path& corners) {
  TELESTRAIN_ASSIGN_OR_RETURN(const Json files, FilesJson(session));
  TELESTRAIN_RETURN_IF_ERROR(RequireUnseenRuler(session, HashesIn(files)));
  Json corners_json = nullptr;
  if (!corners.empty()) {
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(corners, kMostResultBytes));
    corners_json = FileJson(corners.filename().string(), bytes);
  }
  Json json{{"schema", kInputsSchema}, {"program", ProgramRecord()}};
  json.update(SessionRecord(session));
  json["corners"] = corners_json;
  json["files"] = files;
  return JsonText(json);
}

Result<bool> CornersWereGiven(const fs::path& results) {
  TELESTRAIN_ASSIGN_OR_RETURN(
      const Json inputs, ReadJson(results / "inputs.json", kInputsSchema, "telestrain detect"));
  return inputs.contains("corners") && !inputs["corners"].is_null();
}

Result<Session> RecordedSession(const fs::path& results) {
  TELESTRAIN_ASSIGN_OR_RETURN(
      const Json inputs, ReadJson(results / "inputs.json", kInputsSchema, "telestrain detect"));
  try {
    return SessionOfRecord(inputs);
  } catch (const nlohmann::json::exception& e) {
    return BadInput((results / "inputs.json").string() + ": " + JsonProblem(e) +
                    "; run 'telestrain detect' again");
  }
}

Result<std::map<std::string, std::string>> RecordedHashes(const fs::path& results) {
  TELESTRAIN_ASSIGN_OR_RETURN(
      const Json inputs, ReadJson(results / "inputs.json", kInputsSchema, "telestrain detect"));
  std::map<std::string, std::string> recorded;
  try {
    recorded = HashesIn(inputs.at("files"));
  } catch (const nlohmann::json::exception& e) {
    return BadInput((results / "inputs.json").string() + ": " + JsonProblem(e) +
                    "; run 'telestrain detect' again");
  }
  return recorded;
}

Status RequireSameInputs(const Session& session, const fs::path& results) {
  TELESTRAIN_ASSIGN_OR_RETURN(auto recorded, RecordedHashes(results));
  std::vector<std::string> names = TableNames(session);
  for (const std::string& name : ImageNames(session)) names.push_back(name);
  for (const std::string& name : names) {
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string hash, Sha256HexOfFile(session.folder / name));
    if (recorded[name] != hash)
      return BadInput(results.string() + ": was made from another " + name + " than " +
                      (session.folder / name).string() +
                      "; run 'telestrain detect' again or use another --out folder");
  }
  return RequireUnseenRuler(session, recorded);
}

Result<std::map<std::string, std::string>> HashesOf(const fs::path& results,
                                                    std::initializer_list<std::string> names) {
  std::map<std::string, std::string> hashes;
  for (const std::string& name : names) {
    TELESTRAIN_ASSIGN_OR_RETURN(hashes[name], Sha256HexOfFile(results / name));
  }
  return hashes;
}

}  // namespace telestrain
