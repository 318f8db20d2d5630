#include <cctype>
#include <string_view>

#include "report/dcc/dcc_parts.h"

namespace telestrain {
namespace {

void WriteStatement(DccXml& xml, const std::string& name, const std::string& declaration,
                    const DccXml::Attributes& attributes = {}, const std::string& norm = "") {
  if (XmlText(declaration).empty()) return;
  const auto statement = xml.Open("dcc:statement", attributes);
  xml.Text("dcc:name", name);
  xml.Leaf("dcc:norm", norm);
  xml.Text("dcc:declaration", declaration);
}

// One that the session gives.
void WriteGiven(DccXml& xml, const std::string& name, const std::string& declaration,
                const DccXml::Attributes& attributes = {}) {
  if (XmlText(declaration).empty()) return;
  const auto statement = xml.Open("dcc:statement", attributes);
  xml.Text("dcc:name", name);
  xml.GivenText("dcc:declaration", declaration);
}

// Keys of [document] that other parts of the certificate hold, each between blanks.
constexpr std::string_view kPlaced =
    " number report_number revision country country_code laboratory "
    "laboratory_address laboratory_code customer customer_address item instrument "
    "instrument_serial serial_numbers serial_number serial item_serial method "
    "procedure operator reviewer approver authoriser authorised_by authorized_by "
    "environment traceability title condition item_condition target_certificate "
    "ruler_certificate target_serial ruler_serial camera_serial sensor_serial "
    "lens_serial place ";

bool HasPlace(const std::string& key) {
  return kPlaced.find(" " + key + " ") != std::string_view::npos;
}

std::string KeyAsName(std::string key) {
  for (char& c : key)
    if (c == '_') c = ' ';
  if (!key.empty()) key[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(key[0])));
  return key;
}

void WriteDates(DccXml& xml, const Json& results) {
  if (PerformanceDates(results).first.empty())
    WriteStatement(xml, "Date of the calibration",
                   "The date of the calibration is not stated; " + std::string(kNoDate) +
                       " stands in its place.");
}

// dcc:performanceLocation only knows whose place it was.
void WritePlace(DccXml& xml, const Json& results) {
  const std::string place = DocumentFact(results, {"place"});
  if (place.empty()) return;
  const auto statement = xml.Open("dcc:statement");
  xml.Text("dcc:name", "Place of the test");
  const auto location = xml.Open("dcc:location");
  xml.GivenText("dcc:further", place);
}

}  // namespace

void WriteStatements(DccXml& xml, const Json& results) {
  const auto list = xml.Open("dcc:statements");
  WriteStatement(xml, "Decision rule", PrintedAt(results, "/decision/printed"), {},
                 TextAt(results, "/decision/rule") == "simple" ? "" : "ISO 14253-1");
  WriteStatement(xml, "Limits not decided", PrintedAt(results, "/decision/printed_undecided"));
  const std::string traceability = DocumentFact(results, {"traceability"});
  if (traceability.empty())
    WriteStatement(xml, "Traceability", kNotStated);
  else
    WriteGiven(xml, "Traceability", traceability,
               {{"refType", "basic_metrologicallyTraceableToSI"}});
  WriteStatement(xml, "What the results relate to",
                 "The results relate only to the items calibrated.");
  WriteDates(xml, results);
  WritePlace(xml, results);
  WriteGiven(xml, "Title", PrintedAt(results, "/title"));
  const Json& document = EntryAt(results, "/document");
  if (!document.is_object()) return;
  for (const auto& [key, value] : document.items())
    if (!HasPlace(key) && !(key == "date" && !DocumentDay(results, {"date"}).empty()))
      WriteGiven(xml, KeyAsName(key), DocumentFact(results, {key.c_str()}));
}

void WriteMethods(DccXml& xml, const Json& results) {
  const auto methods = xml.Open("dcc:usedMethods");
  const std::string procedure = DocumentFact(results, {"method", "procedure"});
  const auto write = [&](const char* name, const char* about, std::vector<const char*> norms) {
    const auto method = xml.Open("dcc:usedMethod", {{"refType", "basic_calibrationMethod"}});
    xml.Text("dcc:name", name);
    xml.Text("dcc:description", about);
    for (const char* norm : norms) xml.Leaf("dcc:norm", norm);
    xml.Leaf("dcc:reference", procedure);
  };
  write("Telecentric bundle adjustment",
        "All views are fitted to the corners of a target in many poses, moved by a known step "
        "along the stage to decide between the two poses that a telecentric view cannot tell "
        "apart. U holds the noise of the images and the certificate of the target.",
        {});
  if (IsMeasured(results, "ruler"))
    write("Length error on a ruler",
          "The distance of two crosses, measured at many positions, is compared with the "
          "certified length. No ruler image serves the calibration.",
          {"VDI/VDE 2634 Part 1"});
  if (IsMeasured(results, "strain"))
    write("Axial strain by digital image correlation",
          "The change of the distance of two fields on the pipe, over the long base between them.",
          {});
}

void WriteConditions(DccXml& xml, const Json& results) {
  const auto list = xml.Open("dcc:influenceConditions");
  const auto condition = xml.Open("dcc:influenceCondition");
  xml.Text("dcc:name", "Environment during the measurement");
  const auto data = xml.Open("dcc:data");
  xml.GivenText("dcc:text", DocumentFactOr(results, {"environment"}));
}

}  // namespace telestrain
