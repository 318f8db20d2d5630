#include <algorithm>
#include <array>

#include "report/dcc/dcc_parts.h"

namespace telestrain {
namespace {

struct Identity {
  std::string issuer;
  std::string name;
  std::string value;
};

void WriteIdentifications(DccXml& xml, const std::vector<Identity>& identities) {
  const auto list = xml.Open("dcc:identifications");
  for (const Identity& identity : identities) {
    const bool serial = identity.name == "Serial number";
    const auto entry = xml.Open(
        "dcc:identification",
        serial ? DccXml::Attributes{{"refType", "basic_serialNumber"}} : DccXml::Attributes{});
    xml.Leaf("dcc:issuer", identity.issuer);
    xml.Leaf("dcc:value", identity.value);
    xml.Text("dcc:name", identity.name);
  }
}

// The number behind "S/N" that follows `what` in a text such as "camera S/N 40211, lens S/N 0998".
std::string SerialInText(const std::string& text, const std::string& what) {
  const std::string mark = what + " S/N ";
  const std::size_t at = text.find(mark);
  if (at == std::string::npos) return "";
  const std::size_t from = at + mark.size();
  return text.substr(from, text.find_first_of(" ,;)", from) - from);
}

std::string Serial(const Json& results, std::initializer_list<const char*> keys,
                   std::initializer_list<const char*> words) {
  std::string serial = DocumentFact(results, keys);
  const std::string instrument = DocumentFact(results, {"instrument"});
  for (const char* word : words)
    if (serial.empty()) serial = SerialInText(instrument, word);
  return serial.empty() ? kNotStated : serial;
}

struct Part {
  const char* name;
  std::string serial;
  std::vector<const char*> facts;  // rows of the table of artefacts
};

void WriteFacts(DccXml& xml, const Json& results, const char* list, const char* entry,
                const std::vector<const char*>& names) {
  std::vector<DccNumber> numbers;
  for (const Json& row : ListAt(TableOf(results, "artefacts"), "/rows"))
    for (const char* name : names)
      if (row.size() == 3 && PrintedOf(row[0]) == name)
        numbers.push_back({name, "", PrintedOf(row[2]), PrintedOf(row[1]), ""});
  std::erase_if(numbers, [](const DccNumber& number) { return !IsDccNumber(number); });
  if (numbers.empty()) return;
  const auto quantities = xml.Open(list);
  for (const DccNumber& number : numbers) {
    const auto quantity = xml.Open(entry);
    xml.Text("dcc:name", number.label);
    if (number.unit.find("px") != std::string::npos)
      xml.Text("dcc:description", "in pixels, which the D-SI counts as one");
    WriteReal(xml, number, CoverageFactorOf(results));
  }
}

void WritePart(DccXml& xml, const Json& results, const Part& part) {
  const auto item = xml.Open("dcc:item");
  xml.Text("dcc:name", part.name);
  WriteIdentifications(xml, {{"manufacturer", "Serial number", part.serial}});
  WriteFacts(xml, results, "dcc:itemQuantities", "dcc:itemQuantity", part.facts);
}

void WriteInstrument(DccXml& xml, const Json& results) {
  const auto item = xml.Open("dcc:item", {{"id", "instrument"}});
  const std::string name = DocumentFact(results, {"instrument"});
  const std::string serial = DocumentFact(results, {"instrument_serial"});
  if (name.empty()) xml.Text("dcc:name", "Four-view telecentric camera array");
  xml.GivenText("dcc:name", name);
  if (serial.empty() && !name.empty())
    WriteIdentifications(xml, {{"owner", "Instrument", name}});
  else
    WriteIdentifications(xml,
                         {{"manufacturer", "Serial number", serial.empty() ? kNotStated : serial}});
  const auto parts = xml.Open("dcc:subItems");
  WritePart(xml, results,
            {"Sensor",
             Serial(results, {"camera_serial", "sensor_serial"}, {"camera", "sensor"}),
             {"Sensor width", "Sensor height", "Pixel pitch"}});
  WritePart(xml, results,
            {"Telecentric lens",
             Serial(results, {"lens_serial"}, {"lens"}),
             {"Nominal magnification", "Depth of field"}});
}

// What the customer gave to be measured, beside the instrument itself.
void WriteSpecimen(DccXml& xml, const Json& results) {
  const std::string name = DocumentFact(results, {"item"});
  if (name.empty()) return;
  const auto item = xml.Open("dcc:item", {{"id", "specimen"}});
  xml.GivenText("dcc:name", name);
  xml.GivenText("dcc:description", DocumentFact(results, {"condition", "item_condition"}));
  WriteIdentifications(xml, {{"customer", "Item",
                              DocumentFact(results, {"serial_numbers", "item_serial",
                                                     "serial_number", "serial", "item"})}});
  WriteFacts(xml, results, "dcc:itemQuantities", "dcc:itemQuantity",
             {"Pipe outer diameter, nominal", "Pipe Poisson ratio"});
}

void WriteArtefact(DccXml& xml, const Json& results, const char* id, const Part& part,
                   const std::string& certificate) {
  const auto equipment = xml.Open("dcc:measuringEquipment", {{"id", id}});
  xml.Text("dcc:name", part.name);
  WriteIdentifications(xml, {{"manufacturer", "Serial number", part.serial},
                             {"calibrationLaboratory", "Certificate", certificate}});
  WriteFacts(xml, results, "dcc:measuringEquipmentQuantities", "dcc:measuringEquipmentQuantity",
             part.facts);
}

}  // namespace

void WriteItems(DccXml& xml, const Json& results) {
  const auto items = xml.Open("dcc:items");
  WriteInstrument(xml, results);
  WriteSpecimen(xml, results);
}

void WriteEquipment(DccXml& xml, const Json& results) {
  const auto list = xml.Open("dcc:measuringEquipments");
  WriteArtefact(xml, results, "target",
                {"Calibration target",
                 DocumentFactOr(results, {"target_serial"}),
                 {"Board corners along x", "Board corners along y", "Board square",
                  "Corner position on the board, standard uncertainty",
                  "Board separation, standard uncertainty", "Board coplanarity, half-width"}},
                DocumentFactOr(results, {"target_certificate", "traceability"}));
  if (!IsMeasured(results, "ruler")) return;
  WriteArtefact(xml, results, "ruler",
                {"Ruler",
                 DocumentFactOr(results, {"ruler_serial"}),
                 {"Ruler length", "Ruler length, standard uncertainty"}},
                DocumentFactOr(results, {"ruler_certificate", "traceability"}));
}

}  // namespace telestrain
