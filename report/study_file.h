#pragma once

#include <filesystem>
#include <vector>

#include "base/result.h"
#include "base/study_chart.h"
#include "report/json_lookup.h"

namespace telestrain {

// study.json after the checks (study_report.h has the schema).
struct Study {
  // The file with numbers of tables as {"value", "printed"}; texts, comparison, tables, images,
  // notes and settings are read from here.
  Json json;
  std::vector<StudyPlot> plots;
};

// Fails (kBadInput) with the file, the JSON pointer of the first wrong entry and what was wanted.
Result<Study> ReadStudy(const std::filesystem::path& path);

}  // namespace telestrain
