#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace telestrain {

// The data of one chart of a study, as study.json (schema kStudySchema) holds it under "plots". A
// gap in a series is NaN, in the file null.

inline constexpr const char* kStudySchema = "telestrain.study/1";

struct StudyAxis {
  std::string label;
  bool logarithmic = false;             // then every value is positive
  std::optional<double> low{}, high{};  // widen the range
};

// Bars and steps stand at x, as wide as the distance of the values, and start at 0.
enum class SeriesKind { kLine, kMarkers, kBars, kStep };
// As in the file, in the order of the enumerators.
inline constexpr std::array<const char*, 4> kSeriesKindNames = {"line", "markers", "bars", "step"};

struct StudySeries {
  std::string name;
  SeriesKind kind = SeriesKind::kLine;
  std::vector<double> x{}, y{};
  std::vector<double> half_height{};  // of error bars; empty: none
};

struct StudyLimit {
  double y = 0;
  std::string text;
};

struct StudyPlot {
  std::string id, title, caption;
  StudyAxis x, y;
  std::vector<StudySeries> series{};
  std::vector<StudyLimit> limits{};
};

}  // namespace telestrain
