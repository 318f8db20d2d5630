#include "report_reading.h"

#include <set>
#include <stdexcept>

#include "base/files.h"
#include "base/json_file.h"
#include "base/numbers.h"
#include "dcc_reader.h"
#include "pdf_tools.h"
#include "report/template_list.h"

namespace telestrain {
namespace {

template <typename T>
T Value(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(result).value();
}

ReportOptions OptionsOf(const ReportCase& report, ArchiveLevel level) {
  ReportOptions options;
  options.name = report.layout;
  options.language = report.language;
  options.level = level;
  return options;
}

// The same instrument with another ruler check, as an earlier results folder inside this one.
std::filesystem::path MakeEarlier(const std::filesystem::path& folder) {
  Value(MakeResults(folder));
  const std::filesystem::path earlier = folder / "earlier";
  std::filesystem::create_directories(earlier);
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json")
      std::filesystem::copy_file(entry.path(), earlier / entry.path().filename(),
                                 std::filesystem::copy_options::overwrite_existing);
  Json results = ReadResults(folder);
  for (Json& table : results["tables"])
    for (Json& row : table["rows"])
      if (TextAt(table, "/id") == "result-files" && Printed(row[0]) == "ruler.json")
        row[2] = Sha256Hex("another ruler check");
  if (!WriteJson(earlier / "results.json", results)) throw std::runtime_error("not written");
  return earlier;
}

std::string Squeezed(const Json& cell) { return WithoutSpace(Printed(cell)); }

// The ids of the tables that the layout draws of these results.
std::set<std::string> TablesOf(const Json& results, const ReportTemplate& layout) {
  std::set<std::string> ids;
  for (const Json& block : layout.blocks())
    if (block.contains("table") && IsWanted(results, block))
      ids.insert(block["table"].get<std::string>());
  return ids;
}

bool HasHead(const Json& table, const ReportTemplate& layout) {
  for (const Json& block : layout.blocks())
    if (TextAt(block, "/table") == TextAt(table, "/id")) return TextAt(block, "/type") == "table";
  return false;
}

// A head is drawn in one piece: every name with its unit.
std::string HeadOf(const Json& table) {
  std::string head;
  for (const Json& column : ListAt(table, "/columns"))
    head += Squeezed(column["name"]) + Squeezed(column["unit"]);
  return head;
}

}  // namespace

std::vector<ReportCase> AllReportCases() {
  std::vector<ReportCase> cases;
  const TemplateList list = Value(ListTemplates(""));
  for (const NamedTemplate& layout : list.layouts)
    for (const NamedTemplate& language : list.languages)
      cases.push_back({layout.name, language.name});
  return cases;
}

std::string NameOf(const ReportCase& report) { return report.layout + " " + report.language; }

void MakeReport(const std::filesystem::path& folder, const ReportCase& report, ArchiveLevel level) {
  const ReportOptions options = OptionsOf(report, level);
  const LayoutScope layout = Value(ScopeOfLayout(options));
  ReportScope scope = layout.scope;
  if (layout.against_earlier) scope.earlier = MakeEarlier(folder);
  Value(MakeResults(folder, scope));
  if (const Status written = WriteReport(folder, options); !written)
    throw std::runtime_error(written.error().message);
}

Json ReadResults(const std::filesystem::path& folder) {
  return Value(ReadJson(folder / "results.json", "telestrain.results/1", "test"));
}

ReportTemplate TemplateOf(const ReportCase& report) {
  return Value(ReportTemplate::Load({{}, report.layout, report.language}));
}

std::string DrawnText(const std::filesystem::path& folder) {
  const ToolRun run = RunTool(std::string(TELESTRAIN_TOOL_PDFTOTEXT) + " -raw -enc UTF-8 '" +
                              (folder / "report.pdf").string() + "' -");
  if (!run.ok) throw std::runtime_error(run.output);
  return WithoutSpace(run.output);
}

std::vector<std::string> MissingOfTables(const Json& results, const ReportTemplate& layout,
                                         const std::string& drawn) {
  std::vector<std::string> missing;
  const auto expect = [&](const std::string& text, const Json& table) {
    if (drawn.find(text) == std::string::npos)
      missing.push_back(TextAt(table, "/id") + ": " + text);
  };
  const std::set<std::string> wanted = TablesOf(results, layout);
  const Json said = layout.SayTables(results).value();
  for (const Json& table : ListAt(said, "/tables")) {
    if (wanted.count(TextAt(table, "/id")) == 0) continue;
    if (HasHead(table, layout)) expect(HeadOf(table), table);
    for (const Json& column : ListAt(table, "/columns")) expect(Squeezed(column["unit"]), table);
    for (const Json& row : ListAt(table, "/rows")) {
      std::string cells;
      for (const Json& cell : row) cells += Squeezed(cell);
      expect(cells, table);
    }
  }
  return missing;
}

std::vector<std::string> MissingOfQuantities(const Json& results, const ReportTemplate& layout,
                                             const std::string& drawn) {
  std::vector<std::string> missing;
  const auto expect = [&](const std::string& text) {
    if (drawn.find(WithoutSpace(text)) == std::string::npos) missing.push_back(text);
  };
  const TextCatalogue& texts = layout.texts();
  const bool draws_all = !layout.json().contains("scope");
  const Json& rows = ListAt(FindBy(ListAt(results, "/tables"), "id", "summary"), "/rows");
  for (const Json& quantity : ListAt(results, "/quantities")) {
    const auto said = [&](const char* key) { return texts.SayCell(quantity[key]); };
    for (const Json& row : rows) {
      if (row[0] != quantity["label"]) continue;
      const std::string verdict = TextAt(quantity, "/verdict");
      if (TextAt(row[5], "/verdict") != (verdict.empty() ? "undecided" : verdict))
        missing.push_back("verdict of " + quantity.dump());
      expect(said("label") + said("printed") + said("printed_uncertainty") + said("printed_limit") +
             said("unit") + texts.SayCell(row[5]));
    }
    if (draws_all && NumberAt(quantity, "/value")) expect(said("printed"));
    if (const auto k = NumberAt(quantity, "/coverage_factor")) expect("k=" + FormatShortest(*k));
  }
  return missing;
}

}  // namespace telestrain
