#pragma once

#include <string>

#include "base/result.h"
#include "report/json_lookup.h"

namespace telestrain {

// Checks JSON against the part of JSON Schema (2020-12) that the schemas of templates/ use: type,
// const, enum, minimum, maximum, exclusiveMinimum, pattern, required, properties,
// additionalProperties, items, minItems, maxItems, oneOf and $ref to "#/$defs/NAME". Of a oneOf the
// alternative is chosen by its constants (the "type" of a block), or by its required keys where it
// has none. Another keyword in a schema, annotations apart, is a broken contract: no rule is
// skipped silently. The `title` of a rule is what errors call its values: "table", "colour".
//
// Fails (kBadInput) with `where`, the JSON pointer of the entry, what was found, what is allowed
// and the nearest known word. `part`: the rule to check against, "#" or "#/$defs/NAME".
Status CheckAgainstSchema(const Json& schema, const std::string& part, const std::string& where,
                          const Json& value);

// `key` as a step of a JSON pointer (RFC 6901).
std::string PointerStep(const std::string& key);

}  // namespace telestrain
