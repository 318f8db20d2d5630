#include "report/report_template.h"

#include <algorithm>
#include <set>

#include "report/layout_file.h"
#include "report/text_filling.h"

namespace telestrain {
namespace {

// "#14324F", which the schema has checked.
Color ColorOfText(const std::string& text) {
  return ColorOf(static_cast<unsigned>(std::stoul(text.substr(1), nullptr, 16)));
}

// The parts of results.json that hold sentences; names and titles of the session are printed as
// they were given.
bool HoldsSentences(const std::string& key) {
  return key == "decision" || key == "diagnosis" || key == "sentences";
}

bool IsPhrase(const Json& json) { return json.is_object() && json.contains("pattern"); }

// Every sentence in it said, whatever is around them kept.
Json Said(const TextCatalogue& texts, const Json& json) {
  if (json.is_string() || json.is_array() || IsPhrase(json)) return texts.SayPhrase(json);
  if (!json.is_object()) return json;
  Json said = Json::object();
  for (const auto& [key, value] : json.items()) said[key] = Said(texts, value);
  return said;
}

// Tables of the form name, value, unit have wordings, never data, in their first column.
bool IsFacts(const Json& table) {
  return TextAt(table, "/columns/0/name") == "Name" && TextAt(table, "/columns/1/name") == "Value";
}

// Columns with names and, in every row, a cell for each, as all that draws tables takes for
// granted.
bool IsWhole(const Json& table) {
  const Json &columns = EntryAt(table, "/columns"), &rows = EntryAt(table, "/rows");
  const auto is_row = [&](const Json& row) {
    return row.is_array() && !row.empty() && row.size() == columns.size();
  };
  const bool has_rows = rows.is_null() || rows.is_array();
  return table.is_object() && columns.is_array() && has_rows &&
         std::all_of(columns.begin(), columns.end(), [](const Json& c) { return c.is_object(); }) &&
         std::all_of(rows.begin(), rows.end(), is_row);
}

void SayTable(const TextCatalogue& texts, Json& table) {
  const bool facts = IsFacts(table);
  table["title"] = texts.SayPhrase(EntryAt(table, "/title"));
  for (Json& column : table["columns"]) {
    column["name"] = texts.SayPhrase(column["name"]);
    if (column.contains("unit")) column["unit"] = texts.SayCell(column["unit"]);
  }
  for (Json& row : table["rows"])
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string said = facts && i == 0 ? texts.SayPhrase(row[i]) : texts.SayCell(row[i]);
      if (row[i].is_object() && !IsPhrase(row[i]))
        row[i]["printed"] = said;
      else
        row[i] = said;
    }
}

}  // namespace

Status ReportTemplate::ReadLook(const std::filesystem::path& folder) {
  const Json& look = EntryAt(json_, "/look");
  if (!look.is_object()) return {};
  const std::pair<const char*, Color*> colors[] = {
      {"accent", &look_.accent},       {"ink", &look_.ink},
      {"muted", &look_.muted},         {"line", &look_.line},
      {"zebra", &look_.zebra},         {"measured", &look_.measured},
      {"reference", &look_.reference}, {"pass", &look_.pass},
      {"doubt", &look_.doubt},         {"fail", &look_.fail}};
  for (const auto& [key, color] : colors)
    if (look.contains(key)) *color = ColorOfText(look[key].get<std::string>());
  look_.base_size_pt = NumberAt(look, "/base_size_pt").value_or(look_.base_size_pt);
  const std::string logo = TextAt(look, "/logo");
  if (logo.empty()) return {};
  if (folder.empty())
    return BadInput("/look/logo: '" + logo + "' is to lie in a template folder; none is named");
  auto image = ReadPng(folder / logo);
  if (!image) return BadInput("/look/logo: " + image.error().message);
  logo_ = std::move(image).value();
  return {};
}

Result<ReportTemplate> ReportTemplate::Load(const TemplateChoice& choice) {
  TELESTRAIN_ASSIGN_OR_RETURN(const TemplateFolder folder, TemplateFolder::Open(choice.folder));
  ReportTemplate layout;
  TELESTRAIN_ASSIGN_OR_RETURN(layout.json_, ReadNamedLayout(folder, choice.name));
  TELESTRAIN_ASSIGN_OR_RETURN(layout.texts_, TextCatalogue::Load(folder, choice.language));
  layout.texts_.AddLabels(EntryAt(layout.json_, "/labels"));
  if (const Status look = layout.ReadLook(choice.folder); !look)
    return BadInput("layout '" + choice.name + "': " + look.error().message);
  return layout;
}

Result<ReportTemplate> ReportTemplate::Parse(const std::string& name, const std::string& text) {
  TELESTRAIN_ASSIGN_OR_RETURN(const TemplateFolder folder, TemplateFolder::Open({}));
  ReportTemplate layout;
  TELESTRAIN_ASSIGN_OR_RETURN(layout.json_, ReadLayout(folder, {name, text}));
  layout.texts_.AddLabels(EntryAt(layout.json_, "/labels"));
  if (const Status look = layout.ReadLook({}); !look)
    return BadInput(name + ": " + look.error().message);
  return layout;
}

std::string ReportTemplate::Fill(const std::string& text, const Json& values) const {
  return FillText(texts_.Say(text), values);
}

Result<Json> ReportTemplate::SayTables(Json results) const {
  Json said = Json::array();
  for (const Json& table : ListAt(results, "/tables")) {
    if (!IsWhole(table))
      return BadInput(
          "results.json: the table '" + TextAt(table, "/id") +
          "' has a column without a name or a row with more or fewer cells than columns; "
          "make the file again with 'telestrain report'");
    SayTable(texts_, said.emplace_back(table));
  }
  results["tables"] = std::move(said);
  return results;
}

Json ReportTemplate::FillValues(const Json& results) const {
  Json values = Json::object();
  for (const auto& [key, value] : results.items()) {
    if (key == "tables" || key == "quantities" || key == "inputs") continue;
    values[key] = HoldsSentences(key) ? Said(texts_, value) : value;
  }
  std::string number =
      TextAt(results, "/document/number", TextAt(results, "/document/report_number"));
  if (number.empty()) number = texts_.Say("without number");
  int count = 0;
  Json sections = Json::object();
  for (const Json& block : blocks())
    if (block.contains("id") && NumberAt(block, "/level").value_or(1) == 1 &&
        IsWanted(results, block))
      sections[block["id"].get<std::string>()] = std::to_string(++count);
  values["report"] = {{"number", number}, {"revision", TextAt(results, "/document/revision", "0")}};
  values["section"] = std::move(sections);
  values["report"]["title"] = Fill(TextAt(json_, "/title"), values);
  return values;
}

bool IsWanted(const Json& results, const Json& block) {
  const auto measured = [&](const char* key) {
    const std::string part = TextAt(block, std::string("/") + key);
    if (part == "budgets")
      return !ListAt(FindBy(ListAt(results, "/tables"), "id", "budget"), "/rows").empty();
    return EntryAt(results, "/measured/" + part) == true;
  };
  if (block.contains("when") && !measured("when")) return false;
  return !block.contains("unless") || !measured("unless");
}

}  // namespace telestrain
