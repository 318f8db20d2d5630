#pragma once

#include <filesystem>

#include "base/result.h"

namespace telestrain {

// Writes the calibration certificate of a results folder to `file` (DCC 3.3.0) and, when
// `schema_folder` is not empty, checks it against the dcc.xsd there. Fails (kBadInput) when the
// results are incomplete or the certificate breaks the schema, with its line; the file then stays
// to be looked at.
Status ExportCertificate(const std::filesystem::path& results, const std::filesystem::path& file,
                         const std::filesystem::path& schema_folder);

}  // namespace telestrain
