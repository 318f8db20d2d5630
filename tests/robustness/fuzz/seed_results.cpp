#include <sstream>
#include <stdexcept>

#include "base/console.h"
#include "calibration/calibration_file.h"
#include "measurement/state_record.h"
#include "report/acceptance_report.h"
#include "report/results_fixture.h"
#include "report/study_fixture.h"
#include "robustness/fuzz/seed_files.h"
#include "session/session_record.h"
#include "target/detection.h"

namespace telestrain::fuzz {
namespace {

using Json = nlohmann::ordered_json;
using Files = std::vector<std::pair<std::string, std::string>>;

std::string StateLine() {
  StateRecord record;
  record.image = "pipe/pipe_02.png";
  record.made_from = {{"image", "00ff"}, {"options", "subset_px 61"}};
  record.surface_sha256 = "abcd";
  StateStrain& strain = record.state.strain;
  strain.axial_strain = 1e-4;
  strain.local_axial_strain = {1e-4 / 7, 2};
  strain.patch_tensors.resize(1);
  strain.gauges.resize(1);
  strain.mechanical.emplace();
  strain.points_rejected = {{"low correlation", 3}};
  strain.budget = {{"image noise", 1e-7}};
  record.state.motions.resize(2);
  return StateRecordLine(record);
}

// A layout with a block of every kind, small enough to be drawn often.
std::string Layout(const std::string& blocks) {
  return R"({"schema":"telestrain.template/1","title":"Own","author":"{{document.operator}}",)"
         R"("header":{"left":"{{report.title}}","right":"{{report.number}}"},)"
         R"("labels":{"Summary of results":"In short"},"blocks":[)" +
         blocks + "]}\n";
}

void WriteReports(const Seeds& seeds, const Files& parts, const std::string& results) {
  const std::string texts =
      R"({"schema":"telestrain.texts/1","language":"de","name":"Deutsch","texts":)"
      R"({"Own":"Eigen","Page {{page}} of {{pages}}":"Seite {{page}} von {{pages}}"}})";
  const std::vector<std::pair<std::string, std::string>> blocks{
      {"table", R"({"type":"heading","text":"Summary","id":"summary"},)"
                R"({"type":"table","table":"summary","show_title":false})"},
      {"text", R"({"type":"text","text":"{{decision.printed}}","style":"note","when":"strain"},)"
               R"({"type":"page-break"},{"type":"signatures"})"},
      {"picture", R"({"type":"picture","file":"array.png","caption":"c","otherwise":"none"})"},
      {"part", R"({"include":"part"},{"include":"summary"})"}};
  for (const auto& [name, text] : blocks)
    seeds.Write("report", name,
                Joined({{"own/own.json", Layout(text)},
                        {"own/texts/de.json", texts},
                        {"own/sections/part.json", R"([{"type":"text","text":"Part"}])"},
                        {"results.json", results}}));
  for (const char* section : {"calibration", "diagnosis", "ruler", "strain", "changes"}) {
    const std::string include = R"({"include":")" + std::string(section) + "\"}";
    seeds.Write("report", section,
                Joined({{"own/own.json", Layout(include)},
                        {"results.json", results},
                        parts[2],
                        parts[3],
                        parts[6]}));
  }
  seeds.Write("report", "study", Joined({{"study.json", SampleStudy().dump()}}));
}

template <typename T>
T Must(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(result).value();
}

// The lines of residuals.csv of one image and a few of its corners; `count` of them.
std::string FewResiduals(const std::string& table, const std::string& image, int* count) {
  std::istringstream lines(table);
  std::string line, few;
  std::getline(lines, few);
  few += '\n';
  for (int number = 0; std::getline(lines, line); ++number) {
    if (!line.starts_with(image) || number % 23 != 0) continue;
    few += line + '\n';
    ++*count;
  }
  return few;
}

// A real calibration, cut down to its first image.
void WriteCalibration(const Seeds& seeds) {
  const std::filesystem::path folder =
      std::filesystem::path(TELESTRAIN_SOURCE_DIR) / "data/small_session";
  Session session = Must(ReadSession(folder));
  std::ostringstream said;
  Console console(said, said, false);
  session.ruler_images.clear();
  const Detection detection = Must(DetectAll(session, console));
  const Calibration calibration = Must(Calibrate(session, detection.boards));
  const std::string image = session.calibration_images.front().image;
  int count = 0;
  const std::string residuals = FewResiduals(ResidualsCsv(session, calibration), image, &count);
  Json json = CalibrationJson(session, calibration, {});
  json["poses"] = {json["poses"][0]};
  json["reprojection"]["corners_used"] = count;
  Json inputs{{"schema", "telestrain.inputs/1"}};
  inputs.update(SessionRecord(session));
  seeds.Write("calibration", "record",
              Joined({{"inputs.json", inputs.dump()},
                      {"calibration.json", json.dump()},
                      {"residuals.csv", residuals}}));
}

}  // namespace

void WriteResultsSeeds(const Seeds& seeds) {
  WriteCalibration(seeds);
  const ResultsFixture f = PlausibleResults();
  const Files all{{"inputs.json", Short(f.inputs)},
                  {"detection.json", Short(f.detection)},
                  {"calibration.json", Short(f.calibration)},
                  {"mrcal.json", Short(f.diagnosis)},
                  {"ruler.json", Short(f.ruler)},
                  {"strain.json", Short(f.strain)},
                  {"residuals.csv", FirstLines(f.residuals_csv, 6)}};
  seeds.Write("results", "all", Joined(all));
  for (std::size_t i = 1; i + 1 < all.size(); ++i)
    seeds.Write("results", all[i].first, Joined({all[0], all[i]}));
  seeds.Write("calibration", "calibration", Joined({all[0], all[2], all[6]}));
  seeds.Write("calibration", "states", Joined({{"strain_states.jsonl", StateLine()}}));
  const std::filesystem::path folder = TestFolder("seeds");
  WriteResults(f, folder);
  if (const auto made = MakeResults(folder); !made) throw std::runtime_error(made.error().message);
  const std::string results = Short(Json::parse(FileText(folder / "results.json")));
  seeds.Write("results", "earlier",
              Joined({all[0],
                      all[2],
                      {"earlier/results.json", results},
                      {"earlier/calibration.json", all[2].second}}));
  WriteReports(seeds, all, results);
}

}  // namespace telestrain::fuzz
