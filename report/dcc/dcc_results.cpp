#include <algorithm>
#include <array>

#include "base/numbers.h"
#include "report/dcc/dcc_parts.h"
#include "report/result_cells.h"

namespace telestrain {
namespace {

// One dcc:measurementResult: the decided quantities of its sections and its tables.
struct Group {
  const char* name;
  std::vector<const char*> sections;
  std::vector<const char*> tables;
};

const std::array<Group, 3>& Groups() {
  static const std::array<Group, 3> kGroups = {
      Group{"Calibration of the camera array",
            {"calibration", "diagnosis"},
            {"lens", "lens-of-view", "views", "reprojection", "boards", "stage", "gauge",
             "uncertainty"}},
      Group{"Length errors on the ruler",
            {"ruler"},
            {"ruler-summary", "ruler", "ruler-acceptance", "ruler-budget"}},
      Group{"Strain of the pipe",
            {"strain"},
            {"strain-comparison", "strain-states", "pipe", "sequence", "sequence-cycles",
             "strain-budget", "diameter-budget", "noise-floor", "correlation"}}};
  return kGroups;
}

bool BelongsTo(const Group& group, const Json& quantity) {
  const std::string section = TextAt(quantity, "/section");
  return NumberAt(quantity, "/value") &&
         std::find(group.sections.begin(), group.sections.end(), section) != group.sections.end();
}

void WriteLimits(DccXml& xml, const Json& quantity) {
  // "± 10" or "≤ 10".
  const std::string printed = PrintedAt(quantity, "/printed_limit");
  const std::size_t blank = printed.find(' ');
  if (!NumberAt(quantity, "/limit") || blank == std::string::npos) return;
  const std::string bound = printed.substr(blank + 1), unit = TextAt(quantity, "/unit");
  const auto write = [&](const char* name, const char* type, const std::string& value) {
    const DccNumber number{name, type, unit, value, ""};
    if (!IsDccNumber(number)) return;
    const auto entry = xml.Open("dcc:quantity", {{"refType", type}});
    xml.Text("dcc:name", name);
    WriteReal(xml, number, 1);
  };
  const auto data = xml.Open("dcc:data");
  if (TextAt(quantity, "/limit_kind") == "max_abs")
    write("Lower limit", "basic_acceptanceLimitLower", "-" + bound);
  write("Upper limit", "basic_acceptanceLimitUpper", bound);
}

void WriteDecision(DccXml& xml, const Json& quantity) {
  const std::string conformity = ConformityOf(
      TextAt(quantity, "/verdict"), NumberAt(quantity, "/value"), NumberAt(quantity, "/limit"));
  const auto list = xml.Open("dcc:measurementMetaData");
  const auto entry = xml.Open(
      "dcc:metaData", conformity.empty() ? DccXml::Attributes{}
                                         : DccXml::Attributes{{"refType", "basic_conformity"}});
  if (conformity.empty()) xml.Text("dcc:declaration", "No conformity is stated.");
  xml.Leaf("dcc:conformity", conformity);
  WriteLimits(xml, quantity);
  WriteNonSi(xml, TextAt(quantity, "/unit"));
}

void WriteQuantity(DccXml& xml, const Json& quantity, double coverage_factor) {
  const DccNumber number{PrintedAt(quantity, "/label"),
                         "basic_measuredValue telestrain_" + TextAt(quantity, "/id"),
                         TextAt(quantity, "/unit"), PrintedAt(quantity, "/printed"),
                         PrintedAt(quantity, "/printed_uncertainty")};
  const auto element = xml.Open("dcc:quantity", {{"refType", number.ref_types}});
  xml.Text("dcc:name", number.label);
  WriteSmallCoverage(xml, number, coverage_factor);
  if (IsDccNumber(number))
    WriteReal(xml, number, coverage_factor);
  else
    xml.Text("dcc:noQuantity", number.value + " " + number.unit);
  WriteDecision(xml, quantity);
}

void WriteQuantities(DccXml& xml, const Group& group, const Json& results) {
  const Json& quantities = ListAt(results, "/quantities");
  if (std::none_of(quantities.begin(), quantities.end(),
                   [&](const Json& quantity) { return BelongsTo(group, quantity); }))
    return;
  const auto result = xml.Open("dcc:result", {{"refType", "telestrain_quantities"}});
  xml.Text("dcc:name", "Quantities and their limits");
  const auto data = xml.Open("dcc:data");
  for (const Json& quantity : quantities)
    if (BelongsTo(group, quantity)) WriteQuantity(xml, quantity, CoverageFactorOf(results));
}

void WriteDirection(DccXml& xml, const Json& view, const char* key, const char* name) {
  std::string list;
  for (const Json& component : ListAt(view, std::string("/") + key))
    if (component.is_number())
      list += (list.empty() ? "" : " ") + FormatShortest(component.get<double>());
  if (list.empty()) return;
  const auto quantity = xml.Open("dcc:quantity", {{"refType", std::string("telestrain_") + key}});
  xml.Text("dcc:name", name);
  const auto real = xml.Open("si:realListXMLList");
  xml.Leaf("si:valueXMLList", list);
  xml.Leaf("si:unitXMLList", "\\one");
}

// What a program needs beside the printed tables, with all digits of calibration.json.
void WriteDirections(DccXml& xml, const Json& calibration) {
  const Json& views = ListAt(calibration, "/views");
  if (views.empty()) return;
  const auto result = xml.Open("dcc:result", {{"refType", "telestrain_directions"}});
  xml.Text("dcc:name", "Directions of the views in the array frame");
  xml.Text("dcc:description",
           "x, y and z of the unit vectors, as in calibration.json; not rounded.");
  const auto data = xml.Open("dcc:data");
  for (const Json& view : views) {
    if (ListAt(view, "/image_x_in_array").empty()) continue;
    const auto list = xml.Open("dcc:list");
    xml.Text("dcc:name", "View " + TextAt(view, "/name", "?"));
    WriteDirection(xml, view, "image_x_in_array", "Direction of the image's x");
    WriteDirection(xml, view, "image_y_in_array", "Direction of the image's y");
  }
}

bool HasContent(const Group& group, const Json& results) {
  const Json& quantities = ListAt(results, "/quantities");
  return std::any_of(quantities.begin(), quantities.end(),
                     [&](const Json& quantity) { return BelongsTo(group, quantity); }) ||
         std::any_of(group.tables.begin(), group.tables.end(), [&](const char* id) {
           return !ListAt(TableOf(results, id), "/rows").empty();
         });
}

void WriteGroup(DccXml& xml, const Group& group, const Json& results, const Json& calibration) {
  const auto measurement = xml.Open("dcc:measurementResult");
  xml.Text("dcc:name", group.name);
  const auto list = xml.Open("dcc:results");
  WriteQuantities(xml, group, results);
  for (const char* id : group.tables) WriteTable(xml, TableOf(results, id), results);
  if (&group == &Groups().front()) WriteDirections(xml, calibration);
}

// The schema wants one result even where there is none.
void WriteNothing(DccXml& xml) {
  const auto measurement = xml.Open("dcc:measurementResult");
  xml.Text("dcc:name", "No result");
  const auto list = xml.Open("dcc:results");
  const auto result = xml.Open("dcc:result");
  xml.Text("dcc:name", "No result");
  const auto data = xml.Open("dcc:data");
  xml.Text("dcc:text", "Nothing was measured.");
}

}  // namespace

void WriteMeasurementResults(DccXml& xml, const Json& results, const Json& calibration) {
  const auto all = xml.Open("dcc:measurementResults");
  WriteMethods(xml, results);
  WriteEquipment(xml, results);
  WriteConditions(xml, results);
  bool any = false;
  for (const Group& group : Groups()) {
    if (!HasContent(group, results)) continue;
    WriteGroup(xml, group, results, calibration);
    any = true;
  }
  if (!any) WriteNothing(xml);
}

}  // namespace telestrain
