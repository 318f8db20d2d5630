#include "viz/review/results_shape.h"

#include <nlohmann/json.hpp>

#include "viz/scene/json_node.h"

namespace telestrain::viz {
namespace {

using Json = nlohmann::ordered_json;

void RequireObject(const JsonNode& node) { node.Has(""); }

// A text, or an object whose `printed` is one.
void RequireCell(const Json& cell, const JsonNode& node) {
  if (!cell.is_string()) node.At("printed").Text();
}

// The member `key` of `holder`, which is `node`: a text, or a sentence with values in it, whose
// `printed` is one.
void RequireText(const Json& holder, const JsonNode& node, const char* key) {
  const JsonNode entry = node.At(key);
  (holder.at(key).is_object() ? entry.At("printed") : entry).Text();
}

void RequireTable(const Json& table, const JsonNode& node) {
  node.At("id").Text();
  node.At("title").Text();
  const JsonNode columns = node.At("columns"), rows = node.At("rows");
  for (int i = 0; i < columns.Size(); ++i) {
    RequireText(table.at("columns").at(static_cast<std::size_t>(i)), columns.At(i), "name");
    columns.At(i).At("unit").Text();
  }
  for (int i = 0; i < rows.Size(); ++i) {
    const JsonNode row = rows.At(i);
    if (row.Size() != columns.Size())
      row.Fail(std::to_string(columns.Size()) + " cells, one per column, are wanted");
    const Json& cells = table.at("rows").at(static_cast<std::size_t>(i));
    for (int k = 0; k < row.Size(); ++k)
      RequireCell(cells.at(static_cast<std::size_t>(k)), row.At(k));
  }
}

void RequireShape(const Json& results) {
  const JsonNode node(results);
  for (const char* key : {"verdict", "title"}) node.At(key).Text();
  RequireObject(node.At("document"));
  const JsonNode decision = node.At("decision");
  for (const char* key : {"printed", "printed_undecided"})
    RequireText(results.at("decision"), decision, key);
  const JsonNode quantities = node.At("quantities");
  for (int i = 0; i < quantities.Size(); ++i) {
    for (const char* key : {"unit", "printed", "printed_uncertainty", "printed_limit"})
      quantities.At(i).At(key).Text();
    RequireText(results.at("quantities").at(static_cast<std::size_t>(i)), quantities.At(i),
                "label");
  }
  const JsonNode tables = node.At("tables");
  for (int i = 0; i < tables.Size(); ++i)
    RequireTable(results.at("tables").at(static_cast<std::size_t>(i)), tables.At(i));
}

}  // namespace

Status RequireResultsShape(const Json& results, const std::string& file) {
  try {
    RequireShape(results);
  } catch (const BadField& bad) {
    return BadInput(file + ": " + bad.what() + "; run 'telestrain report' again");
  }
  return {};
}

}  // namespace telestrain::viz
