#include "app/correlate_arguments.h"

#include <CLI/CLI.hpp>

#include "base/value_names.h"

namespace telestrain {

void CorrelateArguments::AddTo(CLI::App& app) {
  app.add_option("REF", reference, "image that displacements are measured against")
      ->type_name(kFile)
      ->required();
  app.add_option("IMG", images,
                 "images to measure, in the order they were taken; none: only the "
                 "pattern is assessed")
      ->type_name(kFile);
  app.add_option("--out", out, "folder for the results; made when it does not exist")
      ->type_name(kFolder)
      ->required();
  app.add_option("--subset-px", subset_px,
                 "odd side of the square subsets, 11 to 601 [as the pattern assessment recommends]")
      ->type_name(kPixels);
  app.add_option("--step-px", step_px,
                 "distance of the grid points [as recommended, or a quarter of a given subset]")
      ->type_name(kPixels);
  app.add_option("--order", order, "shape function: 0 shift, 1 affine, 2 quadratic")
      ->type_name(kCount)
      ->check(CLI::Range(0, 2))
      ->capture_default_str();
  app.add_option("--region", region,
                 "where the points lie: x,y,w,h in px, an image as a mask (any non-zero pixel is "
                 "inside), or auto: where there is texture [whole image]")
      ->type_name(kPath);
  app.add_flag("--cubic", cubic, "cubic B-spline instead of the quintic: faster, less true");
  app.add_option("--strain-window", strain_window_points,
                 "odd side of the virtual strain gauge in grid points, 3 to 101")
      ->type_name(kCount)
      ->capture_default_str();
  app.add_option("--incremental", incremental,
                 "on: a reference that correlates too little is replaced by a later image, for "
                 "large motion; off: every image against REF")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  app.add_option("--show", show, "what the colours of the pictures are")
      ->check(CLI::IsMember({"magnitude", "u", "v", "exx", "eyy", "exy"}))
      ->capture_default_str();
  app.add_flag("--assess", assess_only, "only assess the pattern, whatever images there are");
  app.add_option("--threads", threads, "threads; 0: one per core; the results are the same")
      ->type_name(kCount)
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
}

Status CorrelateArguments::Check() const {
  if (subset_px && (*subset_px < kLeastSubset_px || *subset_px > kMostSubset_px))
    return WrongUsage("--subset-px " + std::to_string(*subset_px) + ": the limits are " +
                      std::to_string(kLeastSubset_px) + " and " + std::to_string(kMostSubset_px) +
                      " px; leave the option out for the recommended subset");
  if (subset_px && *subset_px % 2 == 0)
    return WrongUsage("--subset-px " + std::to_string(*subset_px) +
                      ": a subset has a middle pixel, so its side is odd; take " +
                      std::to_string(*subset_px - 1) + " or " + std::to_string(*subset_px + 1));
  if (step_px && *step_px < 1)
    return WrongUsage("--step-px " + std::to_string(*step_px) +
                      ": the least distance of two points is 1 px; leave the option out for the "
                      "recommended step");
  if (strain_window_points < 3 || strain_window_points > 101 || strain_window_points % 2 == 0)
    return WrongUsage(
        "--strain-window " + std::to_string(strain_window_points) +
        ": a strain gauge is an odd number of points wide, from 3 to 101; 5 is usual");
  return {};
}

}  // namespace telestrain
