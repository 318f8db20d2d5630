#include "report/chart_files.h"

#include <algorithm>

#include "base/csv.h"
#include "base/json_file.h"
#include "base/numbers.h"

namespace telestrain {

Result<std::vector<Residual>> ReadResiduals(const std::filesystem::path& folder) {
  std::vector<Residual> residuals;
  const auto path = folder / "residuals.csv";
  if (!std::filesystem::exists(path)) return residuals;
  TELESTRAIN_ASSIGN_OR_RETURN(const CsvTable table, ReadCsv(path));
  const int view = table.Find("view");
  int columns[4];
  const char* names[] = {"u_px", "v_px", "du_px", "dv_px"};
  for (int i = 0; i < 4; ++i) columns[i] = table.Find(names[i]);
  if (view < 0 || *std::min_element(columns, columns + 4) < 0)
    return BadInput(path.string() + ": wants the columns view, u_px, v_px, du_px, dv_px" +
                    "; make it again with 'telestrain calibrate'");
  for (const CsvTable::Row& row : table.rows) {
    double values[4];
    for (int i = 0; i < 4; ++i) {
      const auto value = ParseDouble(row.cells[static_cast<std::size_t>(columns[i])]);
      if (!value)
        return BadInput(path.string() + ":" + std::to_string(row.line) + ": " + names[i] +
                        " is not a number; make it again with 'telestrain calibrate'");
      values[i] = *value;
    }
    residuals.push_back(
        {row.cells[static_cast<std::size_t>(view)], values[0], values[1], values[2], values[3]});
  }
  return residuals;
}

Result<Json> ReadCalibration(const std::filesystem::path& folder) {
  const auto path = folder / "calibration.json";
  if (!std::filesystem::exists(path)) return Json(nullptr);
  return ReadJson(path, "telestrain.calibration/1", "telestrain calibrate");
}

Result<Json> ReadDiagnosis(const std::filesystem::path& folder) {
  const auto path = folder / "mrcal.json";
  if (!std::filesystem::exists(path)) return Json(nullptr);
  return ReadJson(path, "telestrain.mrcal/1", "telestrain diagnose");
}

}  // namespace telestrain
