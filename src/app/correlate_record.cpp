#include "app/correlate_record.h"

#include <nlohmann/json.hpp>

#include "correlation/field_file.h"
#include "correlation/pattern_file.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kMicro = 1e6;

Json InputJson(const InputImage& input) {
  return {{"file", ShownName(input.path)}, {"sha256", input.sha256}};
}

Json RegionJson(const FieldOptions& options) {
  if (!options.region) return "whole image";
  const PixelRegion& region = *options.region;
  return {{"x_px", region.x},
          {"y_px", region.y},
          {"width_px", region.width},
          {"height_px", region.height}};
}

Json OptionsJson(const FieldOptions& options) {
  const CorrelationOptions& subset = options.correlation;
  return {{"subset_px", subset.subset_px},
          {"step_px", options.step_px},
          {"shape_order", subset.shape_order},
          {"interpolant",
           subset.interpolation == Interpolation::kCubic ? "cubic B-spline" : "quintic B-spline"},
          {"criterion", "ZNSSD"},
          {"prefilter_sigma_px", subset.prefilter_sigma_px},
          {"convergence_px", subset.convergence_px},
          {"min_zncc", subset.min_zncc},
          {"min_contrast_gray", subset.min_contrast_gray},
          {"strain_window_points", options.strain_window_points},
          {"update_below_zncc", options.update_below_zncc},
          {"region", RegionJson(options)}};
}

// The words of the files' status column.
Json CountsJson(const FieldSummary& summary) {
  Json counts;
  for (std::size_t status = 0; status < summary.count_of_status.size(); ++status)
    counts[status == 0 ? "ok" : ToText(static_cast<MatchStatus>(status))] =
        summary.count_of_status[status];
  return counts;
}

Json ImageJson(const ImageRecord& image) {
  const FieldSummary& summary = image.summary;
  const Eigen::Vector3d sigma = kMicro * summary.median_sigma_strain;
  const Eigen::Matrix2d strain = kMicro * summary.mean_strain;
  return {{"file", image.name},
          {"sha256", image.sha256},
          {"results", {image.stem + ".csv", image.stem + ".vtp", image.stem + ".png"}},
          {"points", summary.points},
          {"points_by_status", CountsJson(summary)},
          {"points_with_strain", summary.points_with_strain},
          {"reference_updates", image.reference_updates},
          {"mean_u_px", summary.mean_displacement_px.x()},
          {"mean_v_px", summary.mean_displacement_px.y()},
          {"mean_exx_microstrain", strain(0, 0)},
          {"mean_eyy_microstrain", strain(1, 1)},
          {"mean_exy_microstrain", strain(0, 1)},
          {"noise",
           {{"median_sigma_gray", summary.median_sigma_gray},
            {"median_sigma_u_px", summary.median_sigma_px.x()},
            {"median_sigma_v_px", summary.median_sigma_px.y()},
            {"median_sigma_exx_microstrain", sigma.x()},
            {"median_sigma_eyy_microstrain", sigma.y()},
            {"median_sigma_exy_microstrain", sigma.z()},
            {"median_zncc", summary.median_zncc}}}};
}

}  // namespace

nlohmann::ordered_json CorrelateJson(const CorrelateSetup& setup, const InputImage& reference,
                                     const std::vector<ImageRecord>& images) {
  Json image_list = Json::array();
  for (const ImageRecord& image : images) image_list.push_back(ImageJson(image));
  return {{"schema", kCorrelateSchema},
          {"program", "telestrain " TELESTRAIN_VERSION},
          {"reference", InputJson(reference)},
          {"mask", setup.mask ? InputJson(*setup.mask) : Json(nullptr)},
          {"options", OptionsJson(setup.options)},
          {"definitions", FieldDefinitions(setup.options)},
          {"pattern", setup.pattern ? PatternJson(*setup.pattern) : Json(nullptr)},
          {"images", image_list}};
}

nlohmann::ordered_json PatternFileJson(const CorrelateSetup& setup, const InputImage& reference) {
  Json json = {{"schema", kPatternSchema},
               {"reference", InputJson(reference)},
               {"region", RegionJson(setup.options)},
               {"used_subset_px", setup.options.correlation.subset_px},
               {"used_step_px", setup.options.step_px},
               {"points", setup.centers_px.size()}};
  json.update(PatternJson(*setup.pattern));
  return json;
}

}  // namespace telestrain
