#include "report/earlier_results.h"

#include <map>
#include <vector>

#include "base/files.h"
#include "base/json_file.h"
#include "base/numbers.h"
#include "report/reading/pdf_contents.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRemedy =
    "; name the results folder of an earlier 'telestrain report', or its report.pdf";

// A results.json with thousands of states has a few; parsed, it takes many times as much memory.
constexpr std::size_t kMostAttachedJsonBytes = 32 * kMebibyte;

Result<Json> ParseAttachment(const std::string& pdf, const std::string& name,
                             const std::string& text, const std::string& schema) {
  auto json = ParseJson(text);
  if (!json || TextAt(*json, "/schema") != schema)
    return BadInput(pdf + ": its attachment " + name + " is no " + schema + kRemedy);
  return json;
}

Result<EarlierResults> ReadFolder(const fs::path& folder) {
  EarlierResults earlier;
  const fs::path results = folder / "results.json", calibration = folder / "calibration.json";
  if (!fs::exists(results)) return BadInput(folder.string() + ": has no results.json" + kRemedy);
  earlier.file = "results.json";
  TELESTRAIN_ASSIGN_OR_RETURN(earlier.results,
                              ReadJson(results, "telestrain.results/1", "telestrain report"));
  TELESTRAIN_ASSIGN_OR_RETURN(earlier.sha256, Sha256HexOfFile(results));
  if (!fs::exists(calibration)) return earlier;
  TELESTRAIN_ASSIGN_OR_RETURN(earlier.calibration, ReadJson(calibration, "telestrain.calibration/1",
                                                            "telestrain calibrate"));
  TELESTRAIN_ASSIGN_OR_RETURN(earlier.calibration_sha256, Sha256HexOfFile(calibration));
  return earlier;
}

Result<EarlierResults> ReadReport(const fs::path& pdf) {
  EarlierResults earlier;
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(pdf, kMostReportBytes));
  TELESTRAIN_ASSIGN_OR_RETURN(const PdfContents contents, ReadPdfContents(pdf.string(), bytes));
  const auto results = contents.attachments.find("results.json");
  if (results == contents.attachments.end())
    return BadInput(pdf.string() + ": has no attachment results.json" + kRemedy);
  for (const auto& [name, content] : contents.attachments)
    if (content.size() > kMostAttachedJsonBytes)
      return BadInput(pdf.string() + ": its attachment " + name + " has " +
                      std::to_string(content.size()) + " bytes, at most " +
                      std::to_string(kMostAttachedJsonBytes) + " are read" + kRemedy);
  earlier.file = "report.pdf";
  earlier.sha256 = Sha256Hex(bytes);
  TELESTRAIN_ASSIGN_OR_RETURN(
      earlier.results,
      ParseAttachment(pdf.string(), results->first, results->second, "telestrain.results/1"));
  const auto calibration = contents.attachments.find("calibration.json");
  if (calibration == contents.attachments.end()) return earlier;
  TELESTRAIN_ASSIGN_OR_RETURN(earlier.calibration,
                              ParseAttachment(pdf.string(), calibration->first, calibration->second,
                                              "telestrain.calibration/1"));
  earlier.calibration_sha256 = Sha256Hex(calibration->second);
  return earlier;
}

// Of the session, or where it is not known, of the calibration.
std::vector<std::string> ViewNames(const Json& inputs, const Json& calibration) {
  std::vector<std::string> names;
  const Json& of_session = ListAt(inputs, "/views");
  for (const Json& view : of_session.empty() ? ListAt(calibration, "/views") : of_session)
    names.push_back(TextAt(view, "/name", "?"));
  return names;
}

std::string Listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string RegionWords(const Json& inputs, const Json& view) {
  const Json& region =
      EntryAt(FindBy(ListAt(inputs, "/views"), "name", TextAt(view, "/name")), "/region_px");
  return region.is_array() ? region.dump() : "";
}

// What makes two sessions those of different instruments or artefacts, then against now in words;
// "" when nothing does. What one of them does not say is not compared.
std::string Unlike(const Json& then, const Json& now) {
  const auto differ = [](const std::string& what, const std::string& a, const std::string& b) {
    return a.empty() || b.empty() || a == b ? "" : what + " " + a + ", these results have " + b;
  };
  const auto number = [&](const char* what, const char* pointer) {
    const auto a = NumberAt(then, pointer), b = NumberAt(now, pointer);
    return a && b ? differ(what, FormatShortest(*a), FormatShortest(*b)) : "";
  };
  std::vector<std::string> found{number("the sensor width in px", "/sensor/width_px"),
                                 number("the sensor height in px", "/sensor/height_px"),
                                 number("the nominal magnification", "/lens/magnification")};
  for (const Json& view : ListAt(now, "/views"))
    found.push_back(differ("for view " + TextAt(view, "/name", "?") + " the region_px",
                           RegionWords(then, view), RegionWords(now, view)));
  for (const char* key :
       {"instrument_serial", "camera_serial", "lens_serial", "target_serial", "ruler_serial"}) {
    const std::string pointer = std::string("/document/") + key;
    found.push_back(differ(key, TextAt(then, pointer), TextAt(now, pointer)));
  }
  for (const std::string& words : found)
    if (!words.empty()) return words;
  return "";
}

// SHA-256 of the files that hold what was measured.
std::map<std::string, std::string> MeasuredFiles(const Json& table) {
  std::map<std::string, std::string> hashes;
  for (const Json& row : ListAt(table, "/rows"))
    for (const char* name : {"calibration.json", "ruler.json", "strain.json"})
      if (TextAt(row, "/0") == name) hashes[name] = TextAt(row, "/2");
  return hashes;
}

}  // namespace

Result<EarlierResults> ReadEarlierResults(const fs::path& path) {
  if (fs::is_directory(path)) return ReadFolder(path);
  if (!fs::exists(path)) return BadInput(path.string() + ": does not exist" + kRemedy);
  return ReadReport(path);
}

Status RequireComparable(const EarlierResults& earlier, const std::string& name, const Json& inputs,
                         const Json& calibration, const Json& results_files) {
  const auto now = ViewNames(inputs, calibration);
  const auto then = ViewNames(EntryAt(earlier.results, "/inputs"), earlier.calibration);
  if (now != then)
    return BadInput(name + ": has the views '" + Listed(then) + "', these results have '" +
                    Listed(now) + "'; compare reports of one instrument");
  const std::string unlike = Unlike(EntryAt(earlier.results, "/inputs"), inputs);
  if (!unlike.empty())
    return BadInput(name + ": has " + unlike +
                    "; compare reports of one instrument, or correct session.toml");
  const auto files = MeasuredFiles(results_files);
  const Json& before = FindBy(ListAt(earlier.results, "/tables"), "id", "result-files");
  if (!files.empty() && files == MeasuredFiles(before))
    return BadInput(name + ": was made from the very same measurements as these results" + kRemedy);
  return {};
}

}  // namespace telestrain
