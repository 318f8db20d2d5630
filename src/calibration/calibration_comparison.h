#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "calibration/array_calibration.h"
#include "session/session.h"

namespace telestrain {

inline constexpr const char* kComparisonSchema = "telestrain.comparison/1";

// Something that differs between two calibrations, in a unit a person feels.
struct Change {
  std::string quantity;  // "scale over the width of A1", …
  std::string unit;
  double value = 0;                 // new minus old
  double standard_uncertainty = 0;  // of both calibrations' noise; they share the target
  // Beyond chance: larger than three standard uncertainties.
  bool IsSignificant() const;
};

// What moved in the instrument between an earlier calibration and a new one. Two calibrations have
// their own array frames, so the old one is first laid over the new one by the rigid motion that
// makes a lattice of points over all fields (and 1 mm above and below them) fall on the same pixels
// as well as possible. Then, per view: shift of the field, change of scale and turn over its width,
// in um on the object; per further group: the change of its field's distance from the first one's,
// in um, and the strain that an instrument which drifts so between two states of a pipe would feign
// (its sign is opposite). Fails (kBadInput) when the views differ in number or name, or when two
// groups have one middle.
Result<std::vector<Change>> CompareCalibrations(const Session& session,
                                                const ArrayCalibration& old_array,
                                                const ArrayCalibration& new_array);

nlohmann::ordered_json ComparisonJson(const std::vector<Change>& changes,
                                      const std::string& old_name, const std::string& old_sha256);

}  // namespace telestrain
