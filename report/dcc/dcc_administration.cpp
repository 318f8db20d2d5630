#include <algorithm>

#include "base/files.h"
#include "report/dcc/dcc_parts.h"

namespace telestrain {
namespace {

// ISO 3166-1 leaves ZZ to its users; it stands for a country that the session does not name.
constexpr const char* kNoCountry = "ZZ";

bool IsUpper(char c) { return c >= 'A' && c <= 'Z'; }

void WriteSoftware(DccXml& xml, const Json& results) {
  const auto software = xml.Open("dcc:dccSoftware");
  const auto write = [&](const std::string& name, const std::string& release, const char* type) {
    const auto entry = xml.Open("dcc:software");
    xml.Text("dcc:name", name);
    xml.Leaf("dcc:release", release);
    xml.Leaf("dcc:type", type);
  };
  const Json& program = EntryAt(results, "/inputs/program");
  write(TextAt(program, "/name", "telestrain"), TextAt(program, "/version", kNotStated),
        "application");
  const Json& libraries = EntryAt(program, "/libraries");
  if (!libraries.is_object()) return;
  for (const auto& [name, version] : libraries.items())
    write(name, version.is_string() ? version.get<std::string>() : version.dump(), "library");
}

void WriteRefTypes(DccXml& xml) {
  const auto list = xml.Open("dcc:refTypeDefinitions");
  const auto write = [&](const char* name, const char* about, const char* space, const char* link) {
    const auto entry = xml.Open("dcc:refTypeDefinition");
    xml.Text("dcc:name", name);
    xml.Text("dcc:description", about);
    xml.Leaf("dcc:namespace", space);
    xml.Leaf("dcc:link", link);
  };
  write("Basic refTypes", "RefTypes common to all communities.", "basic",
        "https://digilab.ptb.de/dkd/refType/vocab/index.php?tema=2");
  write("RefTypes of telestrain",
        "telestrain_ and the id of a quantity, or of a table and its column, in results.json.",
        "telestrain", "results.json");
}

// The number of the report; without one the hash of everything that the report says.
std::string UniqueIdentifier(const Json& results) {
  const std::string number = DocumentFact(results, {"number", "report_number"});
  if (number.empty())
    return "sha256:" + Sha256Hex(results.dump(-1, ' ', false, Json::error_handler_t::replace));
  const std::string revision = DocumentFact(results, {"revision"});
  return revision.empty() ? number : number + " revision " + revision;
}

void WriteCoreData(DccXml& xml, const Json& results) {
  const auto core = xml.Open("dcc:coreData");
  const std::string country = DocumentFact(results, {"country", "country_code"});
  const bool is_code = country.size() == 2 && IsUpper(country[0]) && IsUpper(country[1]);
  xml.Leaf("dcc:countryCodeISO3166_1", is_code ? country : kNoCountry);
  xml.Leaf("dcc:usedLangCodeISO639_1", "en");
  xml.Leaf("dcc:mandatoryLangCodeISO639_1", "en");
  xml.Leaf("dcc:uniqueIdentifier", UniqueIdentifier(results));
  xml.Leaf("dcc:receiptDate", DocumentDay(results, {"received", "receipt_date", "date_received"}));
  const auto [begin, end] = PerformanceDates(results);
  xml.Leaf("dcc:beginPerformanceDate", begin.empty() ? kNoDate : begin);
  xml.Leaf("dcc:endPerformanceDate", end.empty() ? kNoDate : end);
  const std::string place = DocumentFact(results, {"performance_location"});
  static const auto kPlaces = {"laboratory", "customer", "laboratoryBranch", "customerBranch"};
  const bool known = std::find(kPlaces.begin(), kPlaces.end(), place) != kPlaces.end();
  xml.Leaf("dcc:performanceLocation", known ? place : "other");
  xml.Leaf("dcc:issueDate", DocumentDay(results, {"issued", "issue_date", "date"}));
}

// dcc:contactType wants a location.
void WriteContact(DccXml& xml, const std::string& element, const std::string& name,
                  const std::string& address) {
  const auto contact = xml.Open(element);
  xml.GivenText("dcc:name", name);
  const auto location = xml.Open("dcc:location");
  xml.GivenText("dcc:further", address);
}

void WritePersons(DccXml& xml, const Json& results) {
  const auto list = xml.Open("dcc:respPersons");
  bool first = true;
  const auto write = [&](const std::string& name, const std::string& role) {
    if (name.empty()) return;
    const auto entry = xml.Open("dcc:respPerson");
    {
      const auto person = xml.Open("dcc:person");
      xml.GivenText("dcc:name", name);
    }
    xml.Leaf("dcc:role", role);
    xml.Leaf("dcc:mainSigner", first ? "true" : "false");
    first = false;
  };
  write(DocumentFact(results, {"authorised_by", "authorized_by", "authoriser", "approver"}),
        "approver");
  write(DocumentFact(results, {"reviewer"}), "reviewer");
  write(DocumentFactOr(results, {"operator"}), "operator");
}

}  // namespace

void WriteAdministration(DccXml& xml, const Json& results) {
  const auto administration = xml.Open("dcc:administrativeData");
  WriteSoftware(xml, results);
  WriteRefTypes(xml);
  WriteCoreData(xml, results);
  WriteItems(xml, results);
  {
    const auto laboratory = xml.Open("dcc:calibrationLaboratory");
    xml.Leaf("dcc:calibrationLaboratoryCode", DocumentFact(results, {"laboratory_code"}));
    WriteContact(xml, "dcc:contact", DocumentFactOr(results, {"laboratory"}),
                 DocumentFactOr(results, {"laboratory_address"}));
  }
  WritePersons(xml, results);
  WriteContact(xml, "dcc:customer", DocumentFactOr(results, {"customer"}),
               DocumentFactOr(results, {"customer_address"}));
  WriteStatements(xml, results);
}

}  // namespace telestrain
