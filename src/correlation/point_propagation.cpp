#include "correlation/point_propagation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "correlation/nearest_points.h"

namespace telestrain::correlation {
namespace {

constexpr std::size_t kNearest = 3;         // matches that a point is tried from in a round
constexpr double kAdjacent_spacings = 1.6;  // diagonal neighbours of a grid, and a margin
// A start further away than the adjacent points is tried again only when it is this much nearer
// than the one before it: a front that approaches costs a few tries, not one each round.
constexpr double kWorthAnotherTry = 0.7;
constexpr int kCoarsestCells = 8;    // along the longer side, of the first points from the seeds
constexpr double kOutlier_px = 0.5;  // off the neighbours
constexpr int kLeastNeighbors = 3;
constexpr int kRecheckRounds = 2;

double MiddleOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

ShapeFunction Continue(const KnownMatch& from, const Eigen::Vector2i& center_px) {
  const Eigen::Vector2d way = (center_px - from.center_px).cast<double>();
  ShapeFunction shape = from.shape;
  const auto& k = from.shape.curvature_per_px;
  shape.displacement_px += from.shape.gradient * way;
  shape.displacement_px +=
      k * Eigen::Vector3d(way.x() * way.x() / 2, way.x() * way.y(), way.y() * way.y() / 2);
  shape.gradient.col(0) += k.col(0) * way.x() + k.col(1) * way.y();
  shape.gradient.col(1) += k.col(1) * way.x() + k.col(2) * way.y();
  return shape;
}

PointPropagation::PointPropagation(const ReferenceBands& reference,
                                   const std::vector<Eigen::Vector2i>& centers_px,
                                   const PreparedImage& image)
    : reference_(reference),
      centers_(centers_px),
      image_(image),
      matches_(centers_px.size()),
      attempts_(centers_px.size()),
      excluded_(centers_px.size(), 0) {
  if (centers_.empty()) return;
  low_ = high_ = centers_[0];
  for (const Eigen::Vector2i& center : centers_) {
    low_ = low_.cwiseMin(center);
    high_ = high_.cwiseMax(center);
  }
  const Eigen::Vector2d extent = (high_ - low_).cast<double>() + Eigen::Vector2d::Ones();
  const double count = static_cast<double>(centers_.size());
  spacing_px_ = std::max({1.0, std::sqrt(extent.prod() / count), extent.maxCoeff() / count});
}

void PointPropagation::Exclude(int point, MatchStatus status) {
  excluded_[point] = 1;
  matches_[point].status = status;
}

bool PointPropagation::CanBeTried(int point) const {
  return !excluded_[point] && !matches_[point].ok() &&
         matches_[point].status != MatchStatus::kLowContrast;
}

void PointPropagation::Remember(int point) {
  known_.push_back({centers_[point], matches_[point].shape, matches_[point].zncc});
}

void PointPropagation::MatchFrom(const std::vector<std::optional<ShapeFunction>>& starts) {
  std::vector<int> points;
  for (int i = 0; i < static_cast<int>(centers_.size()); ++i)
    if (!excluded_[i] && starts[starts.size() == 1 ? 0 : i]) points.push_back(i);
  reference_.ForEach(centers_, points, [&](const CorrelationReference& reference, int i) {
    matches_[i] = reference.Match(centers_[i], image_, *starts[starts.size() == 1 ? 0 : i],
                                  reference_.RowThreads(points.size()));
  });
  for (int i : points)
    if (matches_[i].ok()) Remember(i);
}

void PointPropagation::AddSeeds(const std::vector<KnownMatch>& seeds) {
  std::vector<Eigen::Vector2i> places;
  for (const KnownMatch& seed : seeds) places.push_back(seed.center_px);
  std::vector<int> all(seeds.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<SubsetMatch> found(seeds.size());
  reference_.ForEach(places, all, [&](const CorrelationReference& reference, int i) {
    found[i] =
        reference.Match(places[i], image_, seeds[i].shape, reference_.RowThreads(seeds.size()));
  });
  for (std::size_t i = 0; i < seeds.size(); ++i)
    if (found[i].ok()) known_.push_back({places[i], found[i].shape, found[i].zncc});
}

// Every level holds one point of each cell of a size, the sizes halved down to the spacing.
std::vector<std::vector<int>> PointPropagation::Levels() const {
  const Eigen::Vector2d extent = (high_ - low_).cast<double>();
  const int count = static_cast<int>(centers_.size());
  std::vector<std::vector<int>> levels;
  std::vector<char> taken(centers_.size(), 0);
  for (double cell = extent.maxCoeff() / kCoarsestCells; cell > 1.5 * spacing_px_; cell /= 2) {
    const Eigen::Vector2i size = (extent / cell).cast<int>() + Eigen::Vector2i::Ones();
    std::vector<char> filled(static_cast<std::size_t>(size.x()) * size.y(), 0);
    levels.emplace_back();
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector2i at = ((centers_[i] - low_).cast<double>() / cell).cast<int>();
      char& here = filled[static_cast<std::size_t>(at.y()) * size.x() + at.x()];
      if (here || taken[i] || !CanBeTried(i)) continue;
      here = taken[i] = 1;
      levels.back().push_back(i);
    }
  }
  levels.emplace_back();
  for (int i = 0; i < count; ++i)
    if (!taken[i] && CanBeTried(i)) levels.back().push_back(i);
  return levels;
}

void PointPropagation::Spread() {
  if (known_.empty()) return;
  std::vector<int> left_over;
  for (auto& level : Levels()) {
    level.insert(level.end(), left_over.begin(), left_over.end());
    std::sort(level.begin(), level.end());
    TryRound(level, 0);
    left_over.clear();
    for (int i : level)
      if (CanBeTried(i)) left_over.push_back(i);
  }
}

void PointPropagation::RetryFailures() {
  std::vector<int> failed;
  for (int i = 0; i < static_cast<int>(centers_.size()); ++i)
    if (CanBeTried(i)) failed.push_back(i);
  for (std::size_t first_new = 0; !failed.empty() && first_new < known_.size();) {
    const std::size_t known = known_.size();
    TryRound(failed, first_new);
    first_new = known;
    std::erase_if(failed, [&](int i) { return !CanBeTried(i); });
  }
}

void PointPropagation::MatchUntried() {
  std::vector<std::optional<ShapeFunction>> starts(centers_.size());
  for (std::size_t i = 0; i < centers_.size(); ++i)
    if (CanBeTried(static_cast<int>(i)) && attempts_[i].nearest_px == kNever &&
        matches_[i].status == MatchStatus::kNotConverged && matches_[i].iterations == 0)
      starts[i] = ShapeFunction();
  const std::size_t known = known_.size();
  MatchFrom(starts);
  if (known_.size() > known) RetryFailures();
}

void PointPropagation::TryRound(const std::vector<int>& points, std::size_t first_known) {
  std::vector<Eigen::Vector2i> places;
  for (std::size_t k = first_known; k < known_.size(); ++k) places.push_back(known_[k].center_px);
  const NearestPoints tree(places);
  reference_.ForEach(centers_, points, [&](const CorrelationReference& reference, int i) {
    std::vector<int> nearest = tree.Find(centers_[i], kNearest);
    for (int& k : nearest) k += static_cast<int>(first_known);
    // A later failure started nearer: its status says more.
    if (const auto found = TryFrom(reference, i, std::move(nearest))) matches_[i] = *found;
  });
  for (int i : points)
    if (matches_[i].ok()) Remember(i);
}

std::optional<SubsetMatch> PointPropagation::TryFrom(const CorrelationReference& reference,
                                                     int point, std::vector<int> nearest_known) {
  const auto distance = [&](int k) {
    return (known_[k].center_px - centers_[point]).cast<double>().norm();
  };
  const auto cost = [&](int k) { return (distance(k) + spacing_px_) * (1.05 - known_[k].zncc); };
  std::stable_sort(nearest_known.begin(), nearest_known.end(),
                   [&](int a, int b) { return cost(a) < cost(b); });
  std::optional<SubsetMatch> best;
  for (int k : nearest_known) {
    if (!MayTry(attempts_[point], k, distance(k))) continue;
    const SubsetMatch match =
        reference.Match(centers_[point], image_, Continue(known_[k], centers_[point]));
    if (match.ok() || !best) best = match;
    if (match.ok() || match.status == MatchStatus::kLowContrast) break;
  }
  return best;
}

bool PointPropagation::MayTry(Attempt& attempt, int known, double distance_px) const {
  const bool near = distance_px <= kAdjacent_spacings * spacing_px_;
  const auto end = attempt.near.begin() + attempt.near_count;
  if (near && attempt.near_count < static_cast<int>(attempt.near.size()) &&
      std::find(attempt.near.begin(), end, known) == end) {
    attempt.near[attempt.near_count++] = known;
  } else if (near || !(distance_px < kWorthAnotherTry * attempt.nearest_px)) {
    return false;
  }
  attempt.nearest_px = std::min(attempt.nearest_px, distance_px);
  return true;
}

// The prediction of the neighbour that is nearest to the median of all predictions.
std::optional<ShapeFunction> PointPropagation::NeighborsSay(int point, int columns) const {
  const int column = point % columns;
  std::vector<ShapeFunction> say;
  std::vector<double> u, v;
  for (int k = 0; k < 9; ++k) {
    const int dx = k % 3 - 1, dy = k / 3 - 1, other = point + dy * columns + dx;
    if (k == 4 || column + dx < 0 || column + dx >= columns || other < 0 ||
        other >= static_cast<int>(matches_.size()) || !matches_[other].ok())
      continue;
    say.push_back(Continue({centers_[other], matches_[other].shape, 0}, centers_[point]));
    u.push_back(say.back().displacement_px.x());
    v.push_back(say.back().displacement_px.y());
  }
  if (static_cast<int>(say.size()) < kLeastNeighbors) return std::nullopt;
  const Eigen::Vector2d median(MiddleOf(u), MiddleOf(v));
  if (!((matches_[point].shape.displacement_px - median).norm() > kOutlier_px)) return std::nullopt;
  return *std::min_element(say.begin(), say.end(), [&](const auto& a, const auto& b) {
    return (a.displacement_px - median).norm() < (b.displacement_px - median).norm();
  });
}

void PointPropagation::RecheckOutliers(int columns) {
  for (int round = 0; round < kRecheckRounds; ++round) {
    std::vector<int> doubtful;
    std::vector<std::optional<ShapeFunction>> starts(centers_.size());
    for (int i = 0; i < static_cast<int>(centers_.size()); ++i) {
      if (excluded_[i] || !matches_[i].ok()) continue;
      starts[i] = NeighborsSay(i, columns);
      if (starts[i]) doubtful.push_back(i);
    }
    std::vector<char> changed(centers_.size(), 0);
    reference_.ForEach(centers_, doubtful, [&](const CorrelationReference& reference, int i) {
      const SubsetMatch found =
          reference.Match(centers_[i], image_, *starts[i], reference_.RowThreads(doubtful.size()));
      if (!found.ok() || !(found.zncc > matches_[i].zncc)) return;
      matches_[i] = found;
      changed[i] = 1;
    });
    if (std::find(changed.begin(), changed.end(), 1) == changed.end()) return;
  }
}

}  // namespace telestrain::correlation
