#include <libxml/parser.h>

#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/json_file.h"
#include "report/acceptance_report.h"
#include "robustness/fuzz/fuzz_target.h"

namespace telestrain::fuzz {
namespace {

const std::set<std::string> kFiles{"inputs.json",     "detection.json", "calibration.json",
                                   "comparison.json", "mrcal.json",     "ruler.json",
                                   "strain.json",     "residuals.csv"};
const std::set<std::string> kEarlier{"earlier/results.json", "earlier/calibration.json"};

bool IsWellFormedXml(const std::string& text) {
  xmlDocPtr document = xmlReadMemory(text.data(), static_cast<int>(text.size()), "dcc.xml", nullptr,
                                     XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING);
  xmlFreeDoc(document);
  return document != nullptr;
}

}  // namespace

void FuzzResults(std::string_view input) {
  static MemoryFolder folder("results_");
  std::set<std::string> names = kFiles;
  names.insert(kEarlier.begin(), kEarlier.end());
  const auto files = FilesIn(input, names);
  folder.Hold(files, names);
  ReportScope scope;
  if (files.contains("earlier/results.json")) scope.earlier = folder.path() / "earlier";
  if (!Succeeds(MakeResults(folder.path(), scope))) return;
  const auto results = ReadJson(folder.path() / "results.json", "telestrain.results/1", "");
  Require(results.ok(), "results.json reads: " + (results ? "" : results.error().message));
  const auto dcc = ReadFile(folder.path() / "dcc.xml", kMostJsonBytes);
  Require(dcc.ok() && IsWellFormedXml(*dcc), "dcc.xml is well-formed XML");
}

}  // namespace telestrain::fuzz
