#include "base/check.h"
#include "correlation/point_propagation.h"
#include "correlation/subset_correlation.h"

namespace telestrain {

std::vector<SubsetMatch> CorrelatePoints(const CorrelationReference& reference,
                                         const std::vector<Eigen::Vector2i>& centers_px,
                                         const PreparedImage& image,
                                         const std::vector<ShapeFunction>& starts) {
  TELESTRAIN_CHECK(starts.size() == 1 || starts.size() == centers_px.size(),
                   "there must be one start for all points or one for each");
  const correlation::ReferenceBands whole(reference);
  correlation::PointPropagation points(whole, centers_px, image);
  points.MatchFrom(std::vector<std::optional<ShapeFunction>>(starts.begin(), starts.end()));
  points.RetryFailures();
  return points.TakeMatches();
}

}  // namespace telestrain
