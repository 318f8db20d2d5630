#pragma once

#include <optional>
#include <string>
#include <vector>

namespace telestrain {

// A strain of the camera beside the gauges', microstrain; both are changes since the reference.
struct ClassPoint {
  std::string image;
  double indicated = 0;
  double reference = 0;
  double expanded_uncertainty = 0;  // of the difference
};

// The class of an extensometer system that the errors of a sequence allow. A value is within a
// class if its error is within the relative or the absolute limit, whichever is greater.
struct ExtensometerClass {
  std::string standard;  // "ISO 9513:2012, Table 2"
  std::string unit;      // of error, limit, range and resolution: "µm" or "µε"
  std::string name;      // the best class that holds every error; empty: none
  std::string proven;    // the best that holds every |error| + U; empty: none
  int count = 0;
  double range = 0;  // largest size of the reference
  // The value with the least room in `name` (without a class: in the widest one).
  std::string worst_image;
  double worst_error = 0, worst_limit = 0;
  // Half the range of the readings without strain; nothing with fewer than three zero states.
  std::optional<double> resolution;
  std::optional<double> resolution_limit;  // of `name`
  std::vector<std::string> not_covered;    // what the standard asks for beyond this, sentences
};

// Elongations over the long base. Nothing without points or base length. `resolution` in
// microstrain.
std::optional<ExtensometerClass> ClassifyIso9513(const std::vector<ClassPoint>& points,
                                                 std::optional<double> resolution_microstrain,
                                                 double base_length_mm);

// Error of strain. Nothing without points.
std::optional<ExtensometerClass> ClassifyAstmE83(const std::vector<ClassPoint>& points,
                                                 std::optional<double> resolution_microstrain);

}  // namespace telestrain
