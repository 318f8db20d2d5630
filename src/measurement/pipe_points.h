#pragma once

#include <map>
#include <string>
#include <vector>

#include "correlation/subset_correlation.h"
#include "measurement/pipe_locator.h"
#include "measurement/triangulation.h"

namespace telestrain {

// A material point of the pipe's surface, found in both views of its group in the reference image.
struct PipePoint {
  int group = 0;                                      // index into the stereo pairs
  int column = 0, row = 0;                            // in the group's grid
  Eigen::Vector2i first_center_px, second_center_px;  // of the subsets
  Eigen::Vector2d second_pixel;                       // matched, near second_center_px
  Eigen::Vector3d reference_in_array_mm;
};

// Where a point is in one state; `reason` is empty when it is known.
struct TrackedPoint {
  std::string reason;
  std::array<ViewMeasurement, 2> measured;  // covariance of the displacement since the reference
  double zncc = 0;                          // the worse of the two views
};

struct PipeGrid {
  std::vector<StereoPair> pairs;
  std::vector<PipePoint> points;
  Cylinder pipe;  // fitted to all points
  double sigma_diameter_mm = 0;
  double surface_rms_mm = 0;
  std::map<std::string, int> rejected;  // reason -> grid points that were not matched
  int step_px = 0;
};

// Follows a grid of subsets on the pipe: matched across each stereo pair in the reference image,
// then from the reference to every state in every view.
class PipeTracker {
 public:
  // Locates the pipe, matches the grid across the views and fits the cylinder. Fails
  // (kEstimationFailed) when the views cannot be matched.
  static Result<PipeTracker> Start(const Session& session, const ArrayCalibration& array,
                                   const GrayImage& reference, const CorrelationOptions& options);

  const PipeGrid& grid() const { return grid_; }

  // One entry per grid point, in order. Independent of the number of threads.
  std::vector<TrackedPoint> Track(const GrayImage& image) const;

 private:
  PipeTracker() = default;
  Status MatchGroup(const Session& session, int group, const GrayImage& image);
  Status FitPipe(const Session& session);
  void TrackView(const GrayImage& image, int group, int side,
                 std::vector<TrackedPoint>& tracked) const;

  ArrayCalibration array_;
  GrayImage reference_image_;
  std::vector<PixelRegion> regions_;              // one per view
  std::vector<CorrelationReference> references_;  // one per view
  CorrelationOptions options_;
  PipeGrid grid_;
};

}  // namespace telestrain
