#include "app/export_certificate.h"

#include "base/files.h"
#include "base/json_file.h"
#include "report/dcc/dcc.h"
#include "session/made_from.h"

namespace telestrain {

namespace fs = std::filesystem;

Status ExportCertificate(const fs::path& results, const fs::path& file,
                         const fs::path& schema_folder) {
  std::error_code unreadable;
  if (fs::exists(file) &&
      fs::equivalent(file.parent_path().empty() ? "." : file.parent_path(), results, unreadable) &&
      file.filename() != "dcc.xml")
    return BadInput("--dcc " + file.string() +
                    " would replace a file of the results folder; choose another name");
  TELESTRAIN_RETURN_IF_ERROR(RequireConsistent(results, Step::kReport));
  TELESTRAIN_ASSIGN_OR_RETURN(
      const Json json,
      ReadJson(results / "results.json", "telestrain.results/1", "telestrain report"));
  Result<Json> calibration = Json(nullptr);
  if (fs::exists(results / "calibration.json"))
    calibration =
        ReadJson(results / "calibration.json", "telestrain.calibration/1", "telestrain calibrate");
  if (!calibration) return calibration.error();
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string xml, MakeDcc(json, *calibration));
  TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(file, xml));
  if (schema_folder.empty()) return {};
  return ValidateDcc(file.string(), xml, schema_folder);
}

}  // namespace telestrain
