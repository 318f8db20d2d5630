#pragma once

#include <map>
#include <string>
#include <vector>

#include "report/json_lookup.h"

namespace telestrain {

// One dcc:quantity or dcc:metaData's limit, as it stands in the certificate.
struct ReadQuantity {
  std::string ref_types;
  std::string name;
  std::string text;                        // of noQuantity or charsXMLList
  std::vector<std::string> values, units;  // of si:real one each
  std::vector<std::string> uncertainties;  // empty: none
  std::string coverage_factor, coverage_probability;
  std::vector<std::string> conformity;
  std::string lower, upper;  // limits
  std::string non_si_unit;
};

// The quantities of a certificate's results, in its order; limits are parts of their quantity.
// Throws std::runtime_error when it is not XML.
std::vector<ReadQuantity> ReadQuantities(const std::string& xml);

// The text of every element that the XPath finds (prefixes dcc and si), blanks around it removed.
std::vector<std::string> TextsAt(const std::string& xml, const std::string& xpath);

// The text that results.json has for the page, in English: of a text, a cell or a Phrase.
std::string Printed(const Json& cell);

// The first quantity with this refType among its own; an empty one when there is none.
ReadQuantity QuantityOf(const std::vector<ReadQuantity>& quantities, const std::string& ref_type);

}  // namespace telestrain
