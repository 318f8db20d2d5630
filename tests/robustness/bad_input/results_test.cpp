// A results folder whose files are damaged: every reader takes them or says which to make again.
#include <gtest/gtest.h>

#include "app/step_record.h"
#include "base/json_file.h"
#include "calibration/calibration_file.h"
#include "calibration/calibration_record.h"
#include "integration/small_run.h"
#include "robustness/bad_input/damaged_folder.h"
#include "robustness/bad_input/verb_run.h"
#include "session/made_from.h"
#include "session/session.h"
#include "target/detection.h"
#include "unit/base/scratch_folder.h"
#include "viz/scene_from_results.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

template <typename T>
std::optional<Error> ErrorOf(const Result<T>& result) {
  return result ? std::nullopt : std::optional(result.error());
}

class DamagedResults : public SmallRun {
 protected:
  static DamagedFolder& Folder() {
    static DamagedFolder folder(Own());
    return folder;
  }
  // A copy, to be damaged.
  static const fs::path& Own() {
    static const ScratchFolder scratch("telestrain_bad_results_");
    static const fs::path own = [] {
      fs::copy(SmallRun::Results(), scratch.path() / "results", fs::copy_options::recursive);
      return scratch.path() / "results";
    }();
    return own;
  }
  static fs::path Results() { return Own(); }
  static const Session& TheSession() {
    static const Session session = ReadSession(SmallSession()).value();
    return session;
  }
  int Refusals(const std::string& file, const std::vector<Damaged>& damages,
               const DamagedFolder::Reader& read) {
    return Folder().ExpectRefusedOrTaken(file, damages, read);
  }
  // Entries of all kinds in all places, the file cut short and with bytes changed.
  void DamageJson(const std::string& file, const DamagedFolder::Reader& read, int sample) {
    const std::string bytes = Folder().Bytes(file);
    EXPECT_GT(Refusals(file, JsonDamages(Json::parse(bytes), sample), read), 0);
    const auto cut = Truncations(bytes, 12);
    // The last line feed may be missing.
    EXPECT_GE(Refusals(file, cut, read), static_cast<int>(cut.size()) - 1);
    EXPECT_GT(Refusals(file, Flips(bytes, 25), read), 0);
  }
  // `verb RESULTS more…` in this process.
  static DamagedFolder::Reader Verb(const std::string& verb, std::vector<std::string> more = {}) {
    std::vector<std::string> words{verb, Results().string()};
    words.insert(words.end(), more.begin(), more.end());
    return WordsOf(std::move(words));
  }
  static DamagedFolder::Reader WordsOf(std::vector<std::string> words) {
    return [words = std::move(words)]() -> std::optional<Error> {
      const VerbRun run = RunVerb(words);
      if (run.exit_code <= 1) return std::nullopt;
      EXPECT_NE(run.exit_code, 70) << run.err;
      return Error{static_cast<ErrorKind>(run.exit_code), run.err};
    };
  }
};

TEST_F(DamagedResults, CalibrationAndCorners) {
  DamageJson(
      "calibration.json",
      [] { return ErrorOf(ReadArrayCalibration(Results() / "calibration.json")); }, 60);
  DamageJson(
      "detection.json", [] { return ErrorOf(ReadDetectedCrosses(Results())); }, 40);
  const auto boards = [] { return ErrorOf(ReadDetectedBoards(TheSession(), Results())); };
  for (const std::string file : {"corners.vnl", "corner_covariances.csv"}) {
    EXPECT_GT(Refusals(file, Truncations(Folder().Bytes(file), 15), boards), 0) << file;
    EXPECT_GT(Refusals(file, Flips(Folder().Bytes(file), 25), boards), 0) << file;
  }
}

TEST_F(DamagedResults, RecordOfTheCalibration) {
  const auto record = [] { return ErrorOf(ReadCalibrationRecord(TheSession(), Results())); };
  const auto changed =
      JsonDamages(Json::parse(Folder().Bytes("calibration.json")), IsLongForm() ? 2000 : 60);
  EXPECT_GT(Refusals("calibration.json", changed, record), 0);
  EXPECT_GT(Refusals("residuals.csv", Truncations(Folder().Bytes("residuals.csv"), 8), record), 0);
}

TEST_F(DamagedResults, SceneOfInputsRulerAndStrain) {
  const auto scene = [] { return ErrorOf(viz::SceneFromResults(Results())); };
  for (const std::string file : {"inputs.json", "ruler.json", "strain.json"})
    DamageJson(file, scene, 12);
  const std::string surface = Folder().Bytes("pipe_001.vtp");
  EXPECT_GT(Refusals("pipe_001.vtp", Truncations(surface, 15), scene), 10);
  EXPECT_GT(Refusals("pipe_001.vtp", Flips(surface, 25), scene), 0);
}

TEST_F(DamagedResults, WhatWasMadeFromWhat) {
  const auto consistent = [] { return ErrorOf(RequireConsistent(Results(), Step::kReport)); };
  Json json = Json::parse(Folder().Bytes("strain.json"));
  std::vector<Damaged> damages;
  for (const std::string name :
       {"/etc/passwd", "../session.toml", "..", "", "pipe\x1b.json", "missing.json"}) {
    json["made_from"] = {{name, "00"}};
    damages.push_back({name, json.dump()});
  }
  for (const Json& value : {Json(3), Json("x"), Json::array({1}), Json(nullptr)}) {
    json["made_from"] = value;
    damages.push_back({value.dump(), json.dump()});
  }
  damages.push_back({"deep", std::string(100000, '[')});
  damages.push_back({"other schema", R"({"schema": "telestrain.strain/2"})"});
  damages.push_back({"schema of another kind", R"({"schema": [1]})"});
  damages.push_back({"no object", "[]"});
  EXPECT_GE(Refusals("strain.json", damages, consistent), static_cast<int>(damages.size()) - 1);
}

TEST_F(DamagedResults, AuditTrail) {
  const auto open = []() -> std::optional<Error> {
    const Status whole = CheckTrail(Results());
    return whole ? std::nullopt : std::optional(whole.error());
  };
  EXPECT_GT(Refusals("audit.jsonl", Flips(Folder().Bytes("audit.jsonl"), 60), open), 50);
}

// The verbs whole: few cases in the short form, since each may draw and write a report. Not every
// damage is one to every verb.
TEST_F(DamagedResults, EveryVerbThatReadsThem) {
  const int sample = IsLongForm() ? 400 : 4;
  const ScratchFolder scratch("telestrain_bad_verbs_");
  const std::string out = (scratch.path() / "out").string();
  const std::vector<std::pair<std::string, DamagedFolder::Reader>> cases{
      {"calibration.json",
       WordsOf({"verify", SmallSession().string(), "--out", Results().string()})},
      {"inputs.json", WordsOf({"verify", SmallSession().string(), "--out", Results().string()})},
      {"results.json", Verb("review", {"--out", out + ".html"})},
      {"results.json", Verb("export", {"--dcc", out + ".xml"})},
      {"strain.json", Verb("export", {"--out", out, "--format", "stl"})},
      {"mrcal.json", Verb("report")},
      {"strain.json", Verb("report")},
      {"ruler.json", Verb("report")},
      {"calibration.json", Verb("report")}};
  for (const auto& [file, verb] : cases) {
    const auto damages = JsonDamages(Json::parse(Folder().Bytes(file)), sample);
    ASSERT_GE(static_cast<int>(damages.size()), 3) << file;
    EXPECT_GT(Refusals(file, damages, verb), 0) << file;
  }
}

}  // namespace
}  // namespace telestrain::testing_support
