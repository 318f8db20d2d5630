#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

#include "report/dcc/dcc_xml.h"
#include "report/json_lookup.h"

namespace telestrain {

// The parts of a DCC, written in the order of dcc.xsd. `results` is results.json.

inline constexpr const char* kNotStated = "not stated";
// xs:date has no "not stated". Nobody takes this day, the first that it can name, for a real one.
inline constexpr const char* kNoDate = "0001-01-01";

// The first of these keys of [document] that is there, as one line; empty when none is.
std::string DocumentFact(const Json& results, std::initializer_list<const char*> keys);
// The same, or "not stated".
std::string DocumentFactOr(const Json& results, std::initializer_list<const char*> keys);
// The day (YYYY-MM-DD) of the first of these keys that holds an ISO 8601 date; empty when none
// does.
std::string DocumentDay(const Json& results, std::initializer_list<const char*> keys);
// First and last day of the measurement; empty when [document] does not say them.
std::pair<std::string, std::string> PerformanceDates(const Json& results);
// The printed text of a cell of results.json: a text, a number or a Phrase, or a list of them.
std::string PrintedOf(const Json& cell);
std::string PrintedAt(const Json& json, const std::string& pointer);
// The table of this id, or null JSON.
const Json& TableOf(const Json& results, const std::string& id);
bool IsMeasured(const Json& results, const std::string& section);

// dcc:administrativeData.
void WriteAdministration(DccXml& xml, const Json& results);
// dcc:items: the instrument with its sensor and lens, and what was measured with it.
void WriteItems(DccXml& xml, const Json& results);
// dcc:statements: decision rule, traceability, what the results relate to, and every fact of
// [document] that has no place of its own in a DCC.
void WriteStatements(DccXml& xml, const Json& results);

// dcc:usedMethods, dcc:measuringEquipments and dcc:influenceConditions.
void WriteMethods(DccXml& xml, const Json& results);
void WriteEquipment(DccXml& xml, const Json& results);
void WriteConditions(DccXml& xml, const Json& results);

// dcc:measurementResults. `calibration` is calibration.json or null.
void WriteMeasurementResults(DccXml& xml, const Json& results, const Json& calibration);
// A table as dcc:quantity elements and dcc:list elements; nothing when no cell can be written.
void WriteTable(DccXml& xml, const Json& table, const Json& results);

// A number with its unit and, if printed, its expanded uncertainty.
struct DccNumber {
  std::string label;
  std::string ref_types;
  std::string unit;         // as printed
  std::string value;        // as printed
  std::string uncertainty;  // as printed; empty or kNoValue: none
};
// Whether the value is a number and the unit one of the D-SI's.
bool IsDccNumber(const DccNumber& number);
// The D-SI states an expanded uncertainty for coverage factors from 1 on.
bool HasDsiCoverage(double coverage_factor);
// dcc:description of an uncertainty that the D-SI cannot state; else nothing.
void WriteSmallCoverage(DccXml& xml, const DccNumber& number, double coverage_factor);
// si:real; broken contract when IsDccNumber is false.
void WriteReal(DccXml& xml, const DccNumber& number, double coverage_factor);
// The pixel of a unit, as dcc:nonSIDefinition and dcc:nonSIUnit; nothing for SI units.
void WriteNonSi(DccXml& xml, const std::string& printed_unit);
// The DCC's word for a verdict ("pass", "doubt", "fail"); empty when nothing was decided. ILAC-G8
// names the two halves of the guard band: doubt within the limit is a conditional pass, doubt
// beyond it a conditional fail.
std::string ConformityOf(const std::string& verdict, std::optional<double> value,
                         std::optional<double> limit);
double CoverageFactorOf(const Json& results);

}  // namespace telestrain
