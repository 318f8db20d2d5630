#pragma once

#include "style/source_file.h"

namespace telestrain::style {

// A module includes only itself and what stands below it; simulation sees no solver or
// measurement; viz and report see results, not solvers. The list is in CONTRIBUTING.md.
Findings CheckIncludeDirection(const SourceFile& file);

// Headers of big libraries are included in .cpp files only, and only by the modules named in
// the table of include_rules.cpp.
Findings CheckHeavyHeaders(const SourceFile& file);

}  // namespace telestrain::style
