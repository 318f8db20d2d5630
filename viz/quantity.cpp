#include "viz/quantity.h"

#include <algorithm>
#include <array>

namespace telestrain::viz {
namespace {

struct Name {
  const char *key, *name;
};

// What SurfaceVtp() of measurement/pipe_file.h writes.
constexpr std::array kNames{Name{"axial_microstrain", "axial strain"},
                            Name{"hoop_microstrain", "hoop strain"},
                            Name{"shear_microstrain", "shear strain"},
                            Name{"principal_1_microstrain", "first principal strain"},
                            Name{"principal_2_microstrain", "second principal strain"},
                            Name{"principal_angle_deg", "angle of the first principal strain"},
                            Name{"green_axial_microstrain", "axial Green\u2013Lagrange strain"},
                            Name{"green_hoop_microstrain", "hoop Green\u2013Lagrange strain"},
                            Name{"green_shear_microstrain", "shear Green\u2013Lagrange strain"},
                            Name{"radial_deviation_um", "radial deviation from the fitted pipe"},
                            Name{"sigma_um", "standard uncertainty along the pipe"},
                            Name{"zncc", "correlation coefficient (ZNCC)"}};

struct Unit {
  const char *suffix, *printed;
};
constexpr std::array kUnits{Unit{"_microstrain", "\u00b5\u03b5"},
                            Unit{"_um", "\u00b5m"},
                            Unit{"_mm", "mm"},
                            Unit{"_px", "px"},
                            Unit{"_deg", "\u00b0"},
                            Unit{"_rad", "rad"}};

}  // namespace

Quantity QuantityOf(const std::string& key) {
  Quantity quantity{key, key, ""};
  const auto name = std::find_if(kNames.begin(), kNames.end(),
                                 [&](const Name& known) { return key == known.key; });
  if (name != kNames.end()) quantity.name = name->name;
  const auto unit = std::find_if(kUnits.begin(), kUnits.end(),
                                 [&](const Unit& known) { return key.ends_with(known.suffix); });
  if (unit != kUnits.end()) quantity.unit = unit->printed;
  return quantity;
}

}  // namespace telestrain::viz
