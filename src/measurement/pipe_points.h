#pragma once

#include <map>
#include <string>
#include <vector>

#include "correlation/subset_correlation.h"
#include "measurement/pipe_locator.h"
#include "measurement/triangulation.h"
#include "measurement/view_motion.h"

namespace telestrain {

// A material point of the pipe's surface, found in both views of its group in the reference image.
struct PipePoint {
  int group = 0;                                      // index into the stereo pairs
  int column = 0, row = 0;                            // in the group's grid
  Eigen::Vector2i first_center_px, second_center_px;  // of the subsets
  Eigen::Vector2d second_pixel;                       // matched, near second_center_px
  Eigen::Vector3d reference_in_array_mm;
};

// Where a point is in one state; `reason` is empty when it is known. The covariances are enlarged
// where subsets overlap, so that points can be taken as independent.
struct TrackedPoint {
  std::string reason;
  std::array<ViewMeasurement, 2> measured;  // covariance of the displacement since the reference
  double zncc = 0;                          // the worse of the two views
};

// How the pipe's surface is sampled: the subsets and the distance between them.
struct PipeOptions : CorrelationOptions {
  int step_px = 0;  // 0: the subset's side, so that subsets do not overlap
  int Step_px() const { return step_px > 0 ? step_px : subset_px; }
};

// One state as the tracker sees it.
struct TrackedState {
  std::vector<TrackedPoint> points;  // one per grid point, in order
  std::vector<ViewMotion> motions;   // one per view of the session; zero for views without a pair
};

struct PipeGrid {
  std::vector<StereoPair> pairs;
  std::vector<PipePoint> points;
  Cylinder pipe;  // fitted to the points that face both views well
  double sigma_diameter_mm = 0;
  double surface_rms_mm = 0;
  std::map<std::string, int> rejected;  // reason -> grid points that were not matched
  int found_by_search = 0;              // points that only a search along the epipolar line found
  int step_px = 0;
};

// Follows a grid of subsets on the pipe: matched across each stereo pair in the reference image,
// then from the reference to every state in every view.
class PipeTracker {
 public:
  // Locates the pipe, matches the grid across the views and fits the cylinder. Fails
  // (kEstimationFailed) when the views cannot be matched.
  static Result<PipeTracker> Start(const Session& session, const ArrayCalibration& array,
                                   const GrayImage& reference, const PipeOptions& options);

  const PipeGrid& grid() const { return grid_; }

  // `from`: where the views' content was in the state before, or nothing. A view that did not go on
  // from there is searched for. The result is a function of the image and of `from`, to the bit and
  // for any number of threads.
  TrackedState Track(const GrayImage& image, const std::vector<ViewMotion>& from = {}) const;

 private:
  // The points of one group in one of its views: side 0 is the first, 1 the second.
  struct Side {
    int group = 0, side = 0, view = 0;
    std::vector<Eigen::Vector2i> centers_px;
    std::vector<std::size_t> owners;  // of the centers, into the grid's points
  };

  PipeTracker() = default;
  Status MatchGroup(const Session& session, int group, const GrayImage& image);
  Status FitPipe(const Session& session);
  void ListSides();
  void TakeMatches(const Side& side, const std::vector<SubsetMatch>& matches,
                   std::vector<TrackedPoint>& points) const;

  ArrayCalibration array_;
  GrayImage reference_image_;
  std::vector<PixelRegion> regions_;              // one per view
  std::vector<CorrelationReference> references_;  // one per view
  std::vector<Side> sides_;
  PipeOptions options_;
  PipeGrid grid_;
};

}  // namespace telestrain
