#include <algorithm>
#include <cstdint>
#include <tuple>

#include "base/check.h"
#include "base/parallel.h"
#include "correlation/subset_correlation.h"

namespace telestrain {
namespace {

constexpr int kPointsPerTask = 16;
constexpr std::size_t kNeighbors = 3;

// A failed point and the converged points that it can be started from.
struct Retry {
  struct Neighbor {
    std::int64_t distance2_px2;
    int point;
    bool tried;
    bool operator<(const Neighbor& other) const {
      return std::tie(distance2_px2, point) < std::tie(other.distance2_px2, other.point);
    }
  };
  int point;
  std::vector<Neighbor> nearest;  // at most kNeighbors, the nearest first
};

class PointTracker {
 public:
  PointTracker(const CorrelationReference& reference,
               const std::vector<Eigen::Vector2i>& centers_px, const PreparedImage& image)
      : reference_(reference), centers_(centers_px), image_(image), matches_(centers_px.size()) {}

  std::vector<SubsetMatch> Run(const std::vector<ShapeFunction>& starts) {
    ForEach(static_cast<int>(centers_.size()), [&](int i) {
      matches_[i] = reference_.Match(centers_[i], image_, starts[starts.size() == 1 ? 0 : i]);
    });
    RetryFailures();
    return std::move(matches_);
  }

 private:
  template <class Work>
  void ForEach(int count, const Work& work) const {
    const int tasks = (count + kPointsPerTask - 1) / kPointsPerTask;
    ParallelFor(tasks, reference_.options().threads, [&](int task) {
      const int end = std::min(count, (task + 1) * kPointsPerTask);
      for (int i = task * kPointsPerTask; i < end; ++i) work(i);
    });
  }

  // Rounds in which every failed point is tried from those of its nearest converged points that
  // are new to it. A round only reads what the rounds before it found, so the order within it does
  // not matter; the rounds end when one finds nothing.
  void RetryFailures() {
    std::vector<Retry> failed;
    std::vector<int> news;
    for (int i = 0; i < static_cast<int>(matches_.size()); ++i) {
      if (matches_[i].ok())
        news.push_back(i);
      else if (matches_[i].status != MatchStatus::kLowContrast)
        failed.push_back({i, {}});
    }
    while (!failed.empty() && !news.empty()) {
      std::vector<SubsetMatch> found(failed.size());
      ForEach(static_cast<int>(failed.size()), [&](int i) {
        AddNeighbors(news, failed[i]);
        found[i] = TryNeighbors(failed[i]);
      });
      news = Accept(found, failed);
    }
  }

  void AddNeighbors(const std::vector<int>& news, Retry& retry) const {
    for (int point : news) {
      const auto way = (centers_[point] - centers_[retry.point]).cast<std::int64_t>();
      const Retry::Neighbor candidate{way.squaredNorm(), point, false};
      auto& nearest = retry.nearest;
      if (nearest.size() == kNeighbors && !(candidate < nearest.back())) continue;
      nearest.insert(std::upper_bound(nearest.begin(), nearest.end(), candidate), candidate);
      if (nearest.size() > kNeighbors) nearest.pop_back();
    }
  }

  SubsetMatch TryNeighbors(Retry& retry) const {
    SubsetMatch match;
    for (auto& neighbor : retry.nearest) {
      if (neighbor.tried) continue;
      neighbor.tried = true;
      ShapeFunction start = matches_[neighbor.point].shape;
      const Eigen::Vector2i way = centers_[retry.point] - centers_[neighbor.point];
      start.displacement_px += start.gradient * way.cast<double>();
      match = reference_.Match(centers_[retry.point], image_, start);
      if (match.ok()) break;
    }
    return match;
  }

  // Keeps what converged, removes it from the failures and returns its points.
  std::vector<int> Accept(const std::vector<SubsetMatch>& found, std::vector<Retry>& failed) {
    std::vector<int> accepted;
    std::vector<Retry> still_failed;
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (found[i].ok()) {
        matches_[failed[i].point] = found[i];
        accepted.push_back(failed[i].point);
      } else {
        still_failed.push_back(std::move(failed[i]));
      }
    }
    failed = std::move(still_failed);
    return accepted;
  }

  const CorrelationReference& reference_;
  const std::vector<Eigen::Vector2i>& centers_;
  const PreparedImage& image_;
  std::vector<SubsetMatch> matches_;
};

}  // namespace

std::vector<SubsetMatch> CorrelatePoints(const CorrelationReference& reference,
                                         const std::vector<Eigen::Vector2i>& centers_px,
                                         const PreparedImage& image,
                                         const std::vector<ShapeFunction>& starts) {
  TELESTRAIN_CHECK(starts.size() == 1 || starts.size() == centers_px.size(),
                   "there must be one start for all points or one for each");
  return PointTracker(reference, centers_px, image).Run(starts);
}

}  // namespace telestrain
