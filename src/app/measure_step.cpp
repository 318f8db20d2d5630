#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/results_folder.h"
#include "app/step_options.h"
#include "app/step_record.h"
#include "app/steps.h"
#include "app/strain_journal.h"
#include "app/watched_folder.h"
#include "base/files.h"
#include "base/json_file.h"
#include "base/numbers.h"
#include "base/signals.h"
#include "measurement/pipe_file.h"
#include "session/pipe_table.h"
#include "target/image_file.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

constexpr int kSmallestSubset_px = 9, kLargestSubset_px = 301;

// The rows of the session's table.
class TabledImages : public PipeStream {
 public:
  TabledImages(const Session& session, std::map<std::string, std::string> hashes,
               StrainJournal& journal, Console& console)
      : session_(session), hashes_(std::move(hashes)), journal_(journal), console_(console) {}

  Result<std::optional<PipeImage>> Next() override {
    if (row_ == session_.pipe_states.size()) return std::optional<PipeImage>{};
    PipeImage next;
    next.table = session_.pipe_states[row_];
    next.sha256 = hashes_.at(next.table.image);
    if (all_known_) next.known = journal_.Known(row_, next.table, next.sha256);
    all_known_ = next.known.has_value();
    if (row_ == 0 || !next.known) {
      TELESTRAIN_ASSIGN_OR_RETURN(
          next.image, ReadGrayImage(session_.folder / next.table.image, session_.sensor.width_px,
                                    session_.sensor.height_px));
    }
    ++row_;
    return std::optional<PipeImage>(std::move(next));
  }

  Status Keep(const PipeSequence& sequence, const PipeImage& image, const MeasuredState& state,
              double) override {
    TELESTRAIN_RETURN_IF_ERROR(journal_.Add(sequence, image, state));
    console_.Progress("measuring", ++kept_, static_cast<int>(session_.pipe_states.size()));
    return {};
  }

 private:
  const Session& session_;
  const std::map<std::string, std::string> hashes_;
  StrainJournal& journal_;
  Console& console_;
  std::size_t row_ = 0;
  bool all_known_ = true;
  int kept_ = 0;
};

PipeOptions OptionsOf(const Session& session, const MeasureChoices& choices) {
  PipeOptions options = DefaultPipeOptions(session);
  if (choices.subset_px > 0) options.subset_px = choices.subset_px;
  options.step_px = choices.step_px;
  return options;
}

// What every state depends on beside the images.
Result<std::map<std::string, std::string>> MadeFrom(const Session& session, const fs::path& results,
                                                    const PipeOptions& options) {
  TELESTRAIN_ASSIGN_OR_RETURN(auto made_from, HashesOf(results, {"calibration.json"}));
  TELESTRAIN_ASSIGN_OR_RETURN(made_from["session.toml"],
                              Sha256HexOfFile(session.folder / "session.toml"));
  made_from["options"] = PipeOptionsText(options);
  made_from["program"] = TELESTRAIN_VERSION;
  return made_from;
}

Result<PipeMeasurement> MeasureTable(const Session& session, const fs::path& results,
                                     const PipeOptions& options, Console& console) {
  TELESTRAIN_ASSIGN_OR_RETURN(const ArrayCalibration array, LoadCalibration(session, results));
  TELESTRAIN_ASSIGN_OR_RETURN(const auto made_from, MadeFrom(session, results, options));
  TELESTRAIN_ASSIGN_OR_RETURN(auto hashes, RecordedHashes(results));
  StrainJournal journal(results, made_from);
  TabledImages images(session, std::move(hashes), journal, console);
  TELESTRAIN_ASSIGN_OR_RETURN(PipeMeasurement measurement,
                              MeasureStream(session, array, options, images));
  TELESTRAIN_RETURN_IF_ERROR(journal.Finish());
  return measurement;
}

// The session with the gauge columns of the folder's own table, if there is one.
Result<Session> WithColumnsOf(const fs::path& folder, Session session) {
  std::error_code code;
  if (!fs::exists(folder / "pipe.csv", code)) return session;
  TELESTRAIN_ASSIGN_OR_RETURN(PipeTable table, ReadPipeTableOf(session, folder / "pipe.csv"));
  session.gauge_columns = std::move(table.gauge_columns);
  return session;
}

Result<PipeMeasurement> MeasureWatched(const Session& described, const fs::path& results,
                                       const PipeOptions& options, const WatchChoices& choices,
                                       Console& console) {
  TELESTRAIN_ASSIGN_OR_RETURN(const Session session, WithColumnsOf(choices.folder, described));
  TELESTRAIN_ASSIGN_OR_RETURN(const ArrayCalibration array, LoadCalibration(session, results));
  TELESTRAIN_ASSIGN_OR_RETURN(const auto made_from, MadeFrom(session, results, options));
  StrainJournal journal(results, made_from);
  WatchedFolder images(choices, session, journal, console);
  // The first signal ends the watch, with everything written; another one the program.
  bool stopped = false;
  const AtSignal stop([&](int) {
    images.Stop();
    return std::exchange(stopped, true) ? AfterSignal::kEnd : AfterSignal::kGoOn;
  });
  TELESTRAIN_ASSIGN_OR_RETURN(PipeMeasurement measurement,
                              MeasureStream(session, array, options, images));
  TELESTRAIN_RETURN_IF_ERROR(journal.Finish());
  return measurement;
}

// What is no error, and what whoever signs has to know: told at once, and kept for the report.
struct Doubts {
  Console& console;
  std::vector<std::string> texts;

  void Doubt(const std::string& text) {
    console.Warn(text);
    texts.push_back(text);
  }
};

// Noise makes every image another one: equal bytes are a file that was copied or named twice.
void DoubtCopies(const std::vector<MeasuredState>& states,
                 const std::map<std::string, std::string>& hashes, Doubts& doubts) {
  std::map<std::string, std::string> first;  // hash -> image
  std::string example;
  std::size_t copies = 0;
  for (const MeasuredState& state : states) {
    const std::string& image = state.table.image;
    const auto hash = hashes.find(image);
    if (hash == hashes.end()) continue;  // a watched image
    const auto [at, is_new] = first.emplace(hash->second, image);
    if (!is_new && copies++ == 0) example = at->second + " and " + image;
  }
  if (copies == 0) return;
  doubts.Doubt(
      "The pipe images " + example + " have the same bytes" +
      (copies > 1 ? ", and " + CountText(copies - 1, "more image") + " too" : std::string()) +
      ": a state was not recorded, or its image was copied over.");
}

// Strain follows from the pipe as measured; another pipe than is meant is still another one.
void DoubtDiameter(const Session& session, const PipeMeasurement& measurement, Doubts& doubts) {
  constexpr double kMost = 0.03;  // tubes keep to a few tenths of a per cent
  const double nominal_mm = session.pipe.outer_diameter_mm,
               found_mm = measurement.geometry.diameter_mm;
  if (nominal_mm > 0 && std::abs(found_mm / nominal_mm - 1) > kMost)
    doubts.Doubt("The pipe's diameter is " + FormatFixed(found_mm, 3) + " mm as measured and " +
                 FormatShortest(nominal_mm) +
                 " mm in session.toml: another pipe, or a wrong number.");
}

Status WriteMeasurement(const Session& session, const PipeMeasurement& measurement,
                        const fs::path& results, Console& console) {
  TELESTRAIN_ASSIGN_OR_RETURN(
      const auto made_from,
      HashesOf(results, {"inputs.json", "calibration.json", "strain_states.jsonl"}));
  TELESTRAIN_ASSIGN_OR_RETURN(const auto hashes, RecordedHashes(results));
  Doubts doubts{console, {}};
  DoubtCopies(measurement.states, hashes, doubts);
  DoubtDiameter(session, measurement, doubts);
  TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(results / "strain_components.csv",
                                                 StrainComponentsCsv(measurement.states)));
  auto json = StrainJson(measurement, made_from);
  json["doubts"] = doubts.texts;
  TELESTRAIN_RETURN_IF_ERROR(WriteJson(results / "strain.json", json));
  console.Say("measure    " + CountText(measurement.states.size(), "state") + ", " +
              CountText(measurement.grid.points.size(), "surface point") + ", pipe diameter " +
              FormatFixed(measurement.geometry.diameter_mm, 4) + " mm");
  return {};
}

StepRecord MeasureRecord(const Session& session, const MeasureChoices& choices,
                         std::size_t states) {
  StepRecord record{"measure",
                    OptionsJson(choices.arguments),
                    choices.watch ? std::vector<std::string>{"session.toml"} : PipeFiles(session),
                    {"inputs.json", "calibration.json"},
                    {},
                    {"strain.csv", "strain_components.csv", "strain.json", "strain_states.jsonl"}};
  for (std::size_t i = 0; i < states; ++i) record.outputs.push_back(SurfaceFileName(i));
  return record;
}

StepRecord WatchRecord(const Session& session, const MeasureChoices& choices,
                       const PipeMeasurement& measurement) {
  StepRecord record = MeasureRecord(session, choices, measurement.states.size());
  for (const MeasuredState& state : measurement.states)
    record.inputs_elsewhere.push_back(choices.watch->folder /
                                      fs::path(state.table.image).filename());
  return record;
}

// With every surface that lies there as what it might have made.
Result<bool> MeasureIsKept(const Session& session, const fs::path& results,
                           const MeasureChoices& choices, Console& console) {
  StepRecord record = MeasureRecord(session, choices, session.pipe_states.size());
  for (const std::string& name : SurfacesIn(results)) record.outputs.push_back(name);
  return IsKept(results, record, console);
}

Error OutOfRange(const std::string& what) { return {ErrorKind::kUsage, what}; }

}  // namespace

Result<MeasureChoices> ReadChoices(const MeasureArguments& arguments) {
  const int subset_px = arguments.subset_px;
  if (subset_px != 0 &&
      (subset_px < kSmallestSubset_px || subset_px > kLargestSubset_px || subset_px % 2 == 0))
    return OutOfRange("--subset-px " + std::to_string(subset_px) + ": an odd number from " +
                      std::to_string(kSmallestSubset_px) + " to " +
                      std::to_string(kLargestSubset_px) + " is wanted");
  if (arguments.step_px < 0)
    return OutOfRange("--step-px " + std::to_string(arguments.step_px) +
                      ": the distance between subsets is at least 1 px");
  if (arguments.until < 0 || arguments.idle_s < 0)
    return OutOfRange("--until and --idle-s must not be negative");
  MeasureChoices choices{arguments, subset_px, arguments.step_px, {}};
  if (arguments.watch.empty()) return choices;
  std::error_code code;
  if (!fs::is_directory(arguments.watch, code))
    return OutOfRange("--watch " + arguments.watch +
                      ": is no folder; make it before the images arrive");
  choices.watch = WatchChoices{arguments.watch, arguments.until, arguments.idle_s};
  return choices;
}

Status MeasureStep(const Session& session, const fs::path& results, const MeasureChoices& choices,
                   Console& console, Earlier earlier) {
  const PipeOptions options = OptionsOf(session, choices);
  if (choices.watch) {
    TELESTRAIN_ASSIGN_OR_RETURN(const PipeMeasurement measurement,
                                MeasureWatched(session, results, options, *choices.watch, console));
    TELESTRAIN_RETURN_IF_ERROR(WriteMeasurement(session, measurement, results, console));
    return RecordStep(results, WatchRecord(session, choices, measurement));
  }
  if (earlier == Earlier::kKept) {
    TELESTRAIN_ASSIGN_OR_RETURN(const bool kept, MeasureIsKept(session, results, choices, console));
    if (kept) return {};
  }
  const StepRecord record = MeasureRecord(session, choices, session.pipe_states.size());
  if (session.pipe_states.empty()) {
    TELESTRAIN_RETURN_IF_ERROR(LoadCalibration(session, results));
    TELESTRAIN_RETURN_IF_ERROR(RemoveOutputsFrom(results, Step::kMeasure));
    console.Say("measure    the session has no pipe images");
    return RecordStep(results, record);
  }
  TELESTRAIN_ASSIGN_OR_RETURN(const PipeMeasurement measurement,
                              MeasureTable(session, results, options, console));
  TELESTRAIN_RETURN_IF_ERROR(WriteMeasurement(session, measurement, results, console));
  for (const MeasuredState& state : measurement.states)
    console.Note("  " + state.table.image + ": " + FormatFixed(1e6 * state.strain.axial_strain, 2) +
                 " +- " + FormatFixed(1e6 * state.strain.standard_uncertainty, 2) +
                 " microstrain (standard uncertainty)");
  return RecordStep(results, record);
}

}  // namespace telestrain
