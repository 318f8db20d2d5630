#include "viz/review/result_tables.h"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "viz/review/html_text.h"

namespace telestrain::viz {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kOpenTables = {"ruler", "strain-states"};

// A text, or what a sentence with values in it prints.
std::string TextAt(const Json& json, const char* key) {
  if (!json.is_object() || !json.contains(key)) return "";
  const Json& text = json.at(key);
  return text.is_string() ? text.get<std::string>() : TextAt(text, "printed");
}

std::string PrintedOf(const Json& cell) {
  return cell.is_string() ? cell.get<std::string>() : TextAt(cell, "printed");
}

// A number or the dash in its place.
bool IsNumber(const Json& cell) { return cell.is_object() && cell.contains("value"); }

// What stands behind the digits of a plain decimal number, point included; nothing of other texts.
std::size_t FractionLength(const std::string& text) {
  if (text.find_first_not_of("0123456789.-+") != std::string::npos) return 0;
  const std::size_t point = text.find('.');
  return point == std::string::npos ? 0 : text.size() - point;
}

std::string WithMinus(const std::string& text) {
  std::string result;
  for (const char letter : text) result += letter == '-' ? "\u2212" : std::string(1, letter);
  return result;
}

bool IsHash(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

// How a column stands: numbers to the right, those of one unit with their points aligned.
struct ColumnLook {
  bool numbers = false;
  bool aligned = false;
  std::size_t fraction = 0;  // of the longest
};

std::vector<ColumnLook> LooksOf(const Json& table) {
  const Json& columns = table.at("columns");
  std::vector<ColumnLook> looks(columns.size());
  const bool own_units = std::any_of(columns.begin(), columns.end(), [](const Json& column) {
    return TextAt(column, "name") == "Unit";
  });
  for (std::size_t i = 0; i < looks.size(); ++i) {
    std::size_t numbers = 0;
    for (const Json& row : table.at("rows")) {
      if (!IsNumber(row.at(i))) continue;
      ++numbers;
      looks[i].fraction = std::max(looks[i].fraction, FractionLength(PrintedOf(row.at(i))));
    }
    looks[i].numbers = numbers > 0 && 2 * numbers >= table.at("rows").size();
    looks[i].aligned = !own_units;
  }
  return looks;
}

std::string NumberCell(const std::string& printed, const ColumnLook& look) {
  std::string cell = "<td class=\"number\">" + HtmlText(WithMinus(printed));
  const std::size_t own = FractionLength(printed);
  if (look.aligned && own < look.fraction)
    cell += "<i>" + std::string(own == 0 ? "." : "0") + std::string(look.fraction - own - 1, '0') +
            "</i>";
  return cell + "</td>";
}

std::string CellHtml(const Json& cell, const ColumnLook& look) {
  const std::string printed = PrintedOf(cell);
  if (cell.is_object() && cell.contains("verdict"))
    return "<td><span class=\"mark " + LookOf(TextAt(cell, "verdict")).key + "\">" +
           HtmlText(printed) + "</span></td>";
  if (IsNumber(cell)) return NumberCell(printed, look);
  if (look.numbers) return "<td class=\"number\">" + HtmlText(printed) + "</td>";
  if (IsHash(printed)) return "<td><code>" + printed + "</code></td>";
  return "<td>" + HtmlText(printed) + "</td>";
}

std::string HeadHtml(const Json& columns, const std::vector<ColumnLook>& looks) {
  std::string html = "<thead><tr>";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string unit = TextAt(columns.at(i), "unit");
    html += looks[i].numbers ? "<th scope=\"col\" class=\"number\">" : "<th scope=\"col\">";
    html += HtmlText(TextAt(columns.at(i), "name"));
    if (!unit.empty()) html += "<small>" + HtmlText(unit) + "</small>";
    html += "</th>";
  }
  return html + "</tr></thead>\n";
}

std::string GridHtml(const Json& table) {
  const std::vector<ColumnLook> looks = LooksOf(table);
  std::string html =
      "<div class=\"scroll\"><table>" + HeadHtml(table.at("columns"), looks) + "<tbody>";
  for (const Json& row : table.at("rows")) {
    html += "<tr>";
    for (std::size_t i = 0; i < looks.size(); ++i) html += CellHtml(row.at(i), looks[i]);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>";
}

// The sentences of the table "decisions" by quantity.
std::map<std::string, std::string> DecisionsOf(const Json& results) {
  std::map<std::string, std::string> decisions;
  for (const Json& table : results.at("tables")) {
    if (TextAt(table, "id") != "decisions") continue;
    for (const Json& row : table.at("rows"))
      if (row.size() >= 2) decisions[PrintedOf(row.at(0))] = PrintedOf(row.at(1));
  }
  return decisions;
}

Json NumberOf(const Json& quantity, const char* value, const char* printed) {
  return {{"value", quantity.value(value, Json())}, {"printed", TextAt(quantity, printed)}};
}

}  // namespace

VerdictLook LookOf(const std::string& verdict) {
  if (verdict == "pass") return {"pass", "\u2713", "PASS"};
  if (verdict == "fail") return {"fail", "\u2717", "FAIL"};
  if (verdict == "doubt") return {"doubt", "?", "IN DOUBT"};
  return {"undecided", "\u2013", "NOT DECIDED"};
}

std::string TablesHtml(const Json& results) {
  std::string html;
  for (const Json& table : results.at("tables")) {
    const std::string id = TextAt(table, "id");
    const bool open = std::find(kOpenTables.begin(), kOpenTables.end(), id) != kOpenTables.end();
    const std::size_t rows = table.at("rows").size();
    html += open ? "<details open>" : "<details>";
    html += "<summary>" + HtmlText(TextAt(table, "title")) + "<small>" + std::to_string(rows) +
            (rows == 1 ? " row" : " rows") + "</small></summary>\n" + GridHtml(table) +
            "</details>\n";
  }
  return html;
}

std::string ReasonsHtml(const Json& results) {
  const std::map<std::string, std::string> decisions = DecisionsOf(results);
  Json table{{"columns", Json::array()}, {"rows", Json::array()}};
  for (const char* name : {"Verdict", "Quantity", "Result", "U", "Limit", "Unit", "Decision"})
    table["columns"].push_back({{"name", name}, {"unit", ""}});
  for (const Json& quantity : results.at("quantities")) {
    const std::string verdict = TextAt(quantity, "verdict"), label = TextAt(quantity, "label");
    if (verdict.empty()) continue;
    const VerdictLook look = LookOf(verdict);
    const auto decision = decisions.find(label);
    table["rows"].push_back({{{"verdict", verdict}, {"printed", look.sign + " " + verdict}},
                             label,
                             NumberOf(quantity, "value", "printed"),
                             NumberOf(quantity, "expanded_uncertainty", "printed_uncertainty"),
                             NumberOf(quantity, "limit", "printed_limit"),
                             TextAt(quantity, "unit"),
                             decision == decisions.end() ? "" : decision->second});
  }
  return table["rows"].empty() ? "<p>Nothing was asked for, nothing is decided.</p>"
                               : GridHtml(table);
}

}  // namespace telestrain::viz
