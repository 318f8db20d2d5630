#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "correlation/reference_bands.h"

namespace telestrain::correlation {

// A match that others can be started from.
struct KnownMatch {
  Eigen::Vector2i center_px;
  ShapeFunction shape;
  double zncc = 0;
};

// The shape function around `center_px` that continues another one.
ShapeFunction Continue(const KnownMatch& from, const Eigen::Vector2i& center_px);

// Correlates points in rounds. A round only reads what the rounds before it found, so its result
// does not depend on the order or the number of threads within it.
class PointPropagation {
 public:
  PointPropagation(const ReferenceBands& reference, const std::vector<Eigen::Vector2i>& centers_px,
                   const PreparedImage& image);

  // Points that are never tried and keep this status.
  void Exclude(int point, MatchStatus status);
  // Every point from its own start; one without a start is left for the others to reach.
  void MatchFrom(const std::vector<std::optional<ShapeFunction>>& starts);
  // Tries the matches from elsewhere and keeps those that converge, to start points from.
  void AddSeeds(const std::vector<KnownMatch>& seeds);
  // From few known matches to all points: ever denser subsets of the points, each point from the
  // nearest matches so far.
  void Spread();
  // Points that failed are started from converged neighbours, the near and well correlated ones
  // first, until a round finds nothing.
  void RetryFailures();
  // Points that no start has reached are tried at rest, so that their status says why they failed.
  void MatchUntried();
  // For a grid of rows of `columns` points: points that lie off what their neighbours say are
  // started from there too; the better correlation stays. Finds subsets that settled on a wrong
  // part of the pattern and leaves cracks alone.
  void RecheckOutliers(int columns);

  const std::vector<SubsetMatch>& matches() const { return matches_; }
  std::vector<SubsetMatch> TakeMatches() { return std::move(matches_); }

 private:
  static constexpr double kNever = 1e300;
  struct Attempt {
    double nearest_px = kNever;  // of the matches that it was started from
    std::array<int, 4> near{-1, -1, -1, -1};
    int near_count = 0;
  };
  bool CanBeTried(int point) const;
  void Remember(int point);
  // Tries the points from the nearest of known_[first_known..]; remembers those that converge.
  void TryRound(const std::vector<int>& points, std::size_t first_known);
  // Nothing when there was no match that was worth a try.
  std::optional<SubsetMatch> TryFrom(const CorrelationReference& reference, int point,
                                     std::vector<int> nearest_known);
  bool MayTry(Attempt& attempt, int known, double distance_px) const;
  std::vector<std::vector<int>> Levels() const;
  std::optional<ShapeFunction> NeighborsSay(int point, int columns) const;

  const ReferenceBands& reference_;
  const std::vector<Eigen::Vector2i>& centers_;
  const PreparedImage& image_;
  Eigen::Vector2i low_ = Eigen::Vector2i::Zero(), high_ = Eigen::Vector2i::Zero();  // of the points
  double spacing_px_ = 1;
  std::vector<SubsetMatch> matches_;
  std::vector<Attempt> attempts_;
  std::vector<char> excluded_;
  std::vector<KnownMatch> known_;  // only ever grows
};

}  // namespace telestrain::correlation
