#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/study_chart.h"

namespace telestrain {

// One figure of the paper beside ours.
struct StudyComparison {
  std::string quantity, unit;
  std::string paper;        // "-" when the paper gives no number
  std::string ours;         // printed
  std::string limit;        // "-" when nothing is to be met
  std::optional<bool> met;  // nothing: not decided
  std::string differs;      // what is not the same in the two experiments
};

struct StudyColumn {
  std::string name, unit;
};
// A number with the decimals it is printed with, or a text.
struct StudyNumber {
  double value = 0;
  int decimals = 3;
};
using StudyCell = std::variant<std::string, StudyNumber>;

struct StudyTable {
  std::string id, title;
  std::vector<StudyColumn> columns;
  std::vector<std::vector<StudyCell>> rows;
};

struct StudyImage {
  std::string file;  // relative to study.json
  std::string caption;
};

struct StudySetting {
  std::string name, value, unit;
};

// What a study found: study.json (schema kStudySchema) and, laid out, study.pdf.
struct StudyResult {
  std::string study, title, question, answer;
  std::vector<StudyComparison> comparison;
  std::vector<StudyPlot> plots;
  std::vector<StudyTable> tables;
  std::vector<StudyImage> images;
  std::vector<std::string> notes;
  std::vector<StudySetting> settings;

  // Whether every limit that was decided is met.
  bool AllMet() const;
  nlohmann::ordered_json ToJson() const;
  // The comparison as an aligned text table: quantity, paper, ours, limit.
  std::string ComparisonText() const;
};

}  // namespace telestrain
