#include <array>
#include <string>

#include "base/numbers.h"
#include "simulation/virtual_experiment.h"

namespace telestrain {
namespace {

using Options = VirtualExperimentOptions;

constexpr std::array kTable{
    VirtualExperimentOptionInfo{"seed", "", 0, 0x1p53, "number that all randomness follows from",
                                &Options::seed},
    VirtualExperimentOptionInfo{"poses", "", 3, 5000,
                                "target poses; each gives two images, 1 mm apart on the stage",
                                &Options::poses},
    VirtualExperimentOptionInfo{"cut_off_poses", "", 0, 100,
                                "poses among them that one view sees only in part",
                                &Options::cut_off_poses},
    VirtualExperimentOptionInfo{"ruler_images", "", 1, 5000, "images of the ruler",
                                &Options::ruler_images},
    VirtualExperimentOptionInfo{"pipe_states", "", 3, 5000,
                                "images of the pipe, the reference state included",
                                &Options::pipe_states},
    VirtualExperimentOptionInfo{"load_cycles", "", 1, 1000, "times the pipe is loaded and unloaded",
                                &Options::load_cycles},
    VirtualExperimentOptionInfo{"binning", "", 1, 4,
                                "pixels binned along each side: a smaller sensor, coarser pixels",
                                &Options::binning},
    VirtualExperimentOptionInfo{"bit_depth", "bit", 8, 16, "bits of a PNG pixel: 8 or 16",
                                &Options::bit_depth},
    VirtualExperimentOptionInfo{
        "noise_gray", "gray", 0, 20,
        "noise of a pixel, standard deviation on the 8-bit scale, quantisation included",
        &Options::noise_gray},
    VirtualExperimentOptionInfo{"psf_sigma_px", "px", 0.3, 2.0,
                                "Gaussian blur of the lens, standard deviation",
                                &Options::psf_sigma_px},
    VirtualExperimentOptionInfo{"distortion_percent", "%", -2, 2,
                                "radial distortion in a corner of the sensor",
                                &Options::distortion_percent},
    VirtualExperimentOptionInfo{"magnification_error_percent", "%", 0, 2,
                                "largest deviation of the lens from its nominal magnification",
                                &Options::magnification_error_percent},
    VirtualExperimentOptionInfo{"view_error_deg", "deg", 0, 2,
                                "largest rotation of a view from its drawing, per axis",
                                &Options::view_error_deg},
    VirtualExperimentOptionInfo{"view_error_mm", "mm", 0, 0.4,
                                "largest shift of a view from its drawing, per axis",
                                &Options::view_error_mm},
    VirtualExperimentOptionInfo{"stage_error_deg", "deg", 0, 2,
                                "angle between the stage's true and nominal axis",
                                &Options::stage_error_deg},
    VirtualExperimentOptionInfo{"stage_sigma_mm", "mm", 0, 0.05,
                                "standard deviation of the stage's travel",
                                &Options::stage_sigma_mm},
    VirtualExperimentOptionInfo{"separation_error_um", "um", -10, 10,
                                "true minus certified distance of the target's two boards",
                                &Options::separation_error_um},
    VirtualExperimentOptionInfo{"ruler_error_um", "um", -10, 10,
                                "true minus certified length of the ruler",
                                &Options::ruler_error_um},
    VirtualExperimentOptionInfo{"strain_max_microstrain", "microstrain", -5000, 5000,
                                "axial membrane strain at full load",
                                &Options::strain_max_microstrain},
    VirtualExperimentOptionInfo{"bending_max_microstrain", "microstrain", -500, 500,
                                "bending strain of the pipe's outermost fibre at full load",
                                &Options::bending_max_microstrain},
    VirtualExperimentOptionInfo{"gauge_sigma_microstrain", "microstrain", 0, 100,
                                "noise of a strain gauge, standard deviation",
                                &Options::gauge_sigma_microstrain},
    VirtualExperimentOptionInfo{"rigid_motion_mm", "mm", 0, 0.3,
                                "largest shift of the pipe between states, per axis",
                                &Options::rigid_motion_mm},
    VirtualExperimentOptionInfo{"rigid_rotation_deg", "deg", 0, 0.5,
                                "largest rotation of the pipe between states, per axis",
                                &Options::rigid_rotation_deg},
    VirtualExperimentOptionInfo{"gauges", "", 0, 1, "write readings of four strain gauges",
                                &Options::gauges},
    VirtualExperimentOptionInfo{"mirrors", "", 0, 1, "give the views' mirrors beside their vectors",
                                &Options::mirrors},
    VirtualExperimentOptionInfo{"threads", "", 0, 1024, "threads; 0: one per core",
                                &Options::threads},
};

Error OutOfRange(const std::string& name, const std::string& found, const std::string& limit) {
  return {ErrorKind::kUsage, "virtual experiment: " + name + " is " + found + ", wanted " + limit +
                                 "; choose a value inside"};
}

Status CheckRange(const VirtualExperimentOptionInfo& info, double value) {
  if (value >= info.minimum && value <= info.maximum) return {};
  const std::string unit = *info.unit == '\0' ? "" : std::string(" ") + info.unit;
  return OutOfRange(info.name, FormatShortest(value) + unit,
                    FormatShortest(info.minimum) + " to " + FormatShortest(info.maximum) + unit);
}

Status CheckCombinations(const Options& options) {
  if (options.bit_depth != 8 && options.bit_depth != 16)
    return OutOfRange("bit_depth", std::to_string(options.bit_depth), "8 or 16");
  if (options.cut_off_poses > options.poses - 3)
    return OutOfRange("cut_off_poses", std::to_string(options.cut_off_poses),
                      "at most poses - 3 = " + std::to_string(options.poses - 3));
  if (2 * options.load_cycles > options.pipe_states - 1)
    return OutOfRange(
        "load_cycles", std::to_string(options.load_cycles),
        "at most (pipe_states - 1) / 2 = " + std::to_string((options.pipe_states - 1) / 2));
  return {};
}

}  // namespace

std::span<const VirtualExperimentOptionInfo> VirtualExperimentOptionTable() { return kTable; }

Status CheckVirtualExperimentOptions(const Options& options) {
  for (const VirtualExperimentOptionInfo& info : VirtualExperimentOptionTable()) {
    const double value = std::visit(
        [&options](auto member) { return static_cast<double>(options.*member); }, info.member);
    TELESTRAIN_RETURN_IF_ERROR(CheckRange(info, value));
  }
  return CheckCombinations(options);
}

}  // namespace telestrain
