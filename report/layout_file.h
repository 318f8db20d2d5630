#pragma once

#include <string>

#include "base/result.h"
#include "report/template_folder.h"

namespace telestrain {

// A layout, checked against templates/template.schema.json, with every {"include": NAME} replaced
// by the blocks of sections/NAME.json. Fails (kBadInput) with the file, the JSON pointer of the
// entry, what was found and the nearest known word.
Result<Json> ReadLayout(const TemplateFolder& folder, const TemplateFile& file);

// The layout NAME.json. Fails (kUsage) when there is none of that name, with the nearest.
Result<Json> ReadNamedLayout(const TemplateFolder& folder, const std::string& name);

}  // namespace telestrain
