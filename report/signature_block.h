#pragma once

#include "report/report_blocks.h"

namespace telestrain {

// The boxes of who signs: one for each of the block's "roles", side by side, and below them one for
// the instrument's seal, each with a signature field named like the role in small letters. Never
// broken over pages.
Status DrawSignatures(const ReportContext& context, const Json& block);

}  // namespace telestrain
