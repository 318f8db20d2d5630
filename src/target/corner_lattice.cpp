#include "target/corner_lattice.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>

namespace telestrain {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kLineTolerance_rad = 0.35;     // all corners of a telecentric view agree
constexpr double kPolarityTolerance_rad = 0.7;  // the alternative is pi/2
constexpr double kSeedCone = 0.27;              // tangent of 15 deg
constexpr double kSeedSpacingTolerance = 0.25;
constexpr double kGrowthTolerance = 0.25;  // of the spacing, per lattice coordinate
constexpr int kLeastCorners = 5;
// A smaller grid may be an accident; its corners stay free for others.
constexpr std::size_t kLeastToKeep = 16;

// Finds candidates near a place, by buckets of a fixed size.
class CandidateMap {
 public:
  CandidateMap(const std::vector<SaddleCandidate>& candidates, double bucket_px)
      : bucket_px_(bucket_px) {
    for (std::size_t i = 0; i < candidates.size(); ++i)
      buckets_[Bucket(candidates[i].pixel)].push_back(static_cast<int>(i));
  }

  // Calls visit(index) for at least all candidates within `radius_px` of `pixel`.
  template <typename Visit>
  void VisitNear(const Vector2d& pixel, double radius_px, const Visit& visit) const {
    const auto low = Bucket(pixel.array() - radius_px), high = Bucket(pixel.array() + radius_px);
    for (int x = low.first; x <= high.first; ++x)
      for (int y = low.second; y <= high.second; ++y)
        if (const auto found = buckets_.find({x, y}); found != buckets_.end())
          for (const int index : found->second) visit(index);
  }

 private:
  std::pair<int, int> Bucket(const Vector2d& pixel) const {
    return {static_cast<int>(std::floor(pixel.x() / bucket_px_)),
            static_cast<int>(std::floor(pixel.y() / bucket_px_))};
  }
  double bucket_px_;
  std::map<std::pair<int, int>, std::vector<int>> buckets_;
};

bool SameLines(const SaddleCandidate& a, const SaddleCandidate& b) {
  const auto &p = a.line_angle_rad, &q = b.line_angle_rad;
  const double straight = std::max(AngleBetweenLines(p[0], q[0]), AngleBetweenLines(p[1], q[1]));
  const double crossed = std::max(AngleBetweenLines(p[0], q[1]), AngleBetweenLines(p[1], q[0]));
  return std::min(straight, crossed) < kLineTolerance_rad;
}

bool OppositeContrast(const SaddleCandidate& a, const SaddleCandidate& b) {
  return AngleBetweenLines(a.bright_angle_rad, b.bright_angle_rad + 0.5 * std::numbers::pi) <
         kPolarityTolerance_rad;
}

// A corner on the growing grid with the local steps to its neighbours.
struct Node {
  int candidate = 0;
  Matrix2d axes_px;
};

class LatticeGrower {
 public:
  LatticeGrower(const std::vector<SaddleCandidate>& candidates, double longest_side_px)
      : candidates_(candidates),
        longest_side_px_(longest_side_px),
        map_(candidates, longest_side_px),
        taken_(candidates.size(), false) {}

  // The grid about one corner; nothing if it is taken or has no four neighbours. Its corners are
  // not offered again.
  std::optional<std::map<LatticeIndex, Vector2d>> GrowFrom(int seed);

 private:
  std::optional<Vector2d> Step(int seed, const Vector2d& direction) const;
  std::optional<Matrix2d> SeedAxes(int seed) const;
  std::optional<int> Find(const Node& from, const Vector2d& step) const;

  const std::vector<SaddleCandidate>& candidates_;
  double longest_side_px_;
  CandidateMap map_;
  std::vector<bool> taken_;
};

// The vector to the nearest fitting neighbour in a cone about `direction`.
std::optional<Vector2d> LatticeGrower::Step(int seed, const Vector2d& direction) const {
  const SaddleCandidate& center = candidates_[static_cast<std::size_t>(seed)];
  std::optional<Vector2d> nearest;
  double least = longest_side_px_;
  map_.VisitNear(center.pixel, longest_side_px_, [&](int index) {
    const SaddleCandidate& other = candidates_[static_cast<std::size_t>(index)];
    const Vector2d step = other.pixel - center.pixel;
    const double along = step.dot(direction);
    const double across = direction.x() * step.y() - direction.y() * step.x();
    if (index == seed || along <= 0 || along >= least || std::abs(across) > kSeedCone * along)
      return;
    if (!OppositeContrast(center, other) || !SameLines(center, other)) return;
    nearest = step;
    least = along;
  });
  return nearest;
}

std::optional<Matrix2d> LatticeGrower::SeedAxes(int seed) const {
  Matrix2d axes;
  for (int line = 0; line < 2; ++line) {
    const double angle =
        candidates_[static_cast<std::size_t>(seed)].line_angle_rad[static_cast<std::size_t>(line)];
    const Vector2d direction(std::cos(angle), std::sin(angle));
    const auto forward = Step(seed, direction), backward = Step(seed, -direction);
    if (!forward || !backward) return std::nullopt;
    axes.col(line) = 0.5 * (*forward - *backward);
    const double bend = (*forward + *backward).norm();
    if (bend > kSeedSpacingTolerance * axes.col(line).norm()) return std::nullopt;
  }
  return axes;
}

// The free candidate at node + step, within the tolerance and of opposite contrast.
std::optional<int> LatticeGrower::Find(const Node& from, const Vector2d& step) const {
  const SaddleCandidate& neighbour = candidates_[static_cast<std::size_t>(from.candidate)];
  const Vector2d predicted = neighbour.pixel + step;
  const Matrix2d to_lattice = from.axes_px.inverse();
  const double radius =
      kGrowthTolerance * (from.axes_px.col(0).norm() + from.axes_px.col(1).norm());
  std::optional<int> nearest;
  double least = kGrowthTolerance;
  map_.VisitNear(predicted, radius, [&](int index) {
    const SaddleCandidate& other = candidates_[static_cast<std::size_t>(index)];
    const double off = (to_lattice * (other.pixel - predicted)).cwiseAbs().maxCoeff();
    if (off >= least || taken_[static_cast<std::size_t>(index)]) return;
    if (!OppositeContrast(neighbour, other) || !SameLines(neighbour, other)) return;
    nearest = index;
    least = off;
  });
  return nearest;
}

std::optional<std::map<LatticeIndex, Vector2d>> LatticeGrower::GrowFrom(int seed) {
  if (taken_[static_cast<std::size_t>(seed)]) return std::nullopt;
  const auto axes = SeedAxes(seed);
  if (!axes || std::abs(axes->determinant()) < 1) return std::nullopt;
  std::map<LatticeIndex, Node> nodes{{{0, 0}, {seed, *axes}}};
  taken_[static_cast<std::size_t>(seed)] = true;
  std::deque<LatticeIndex> open{{0, 0}};
  constexpr std::array<std::array<int, 3>, 4> kMoves{
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 1}, {0, -1, 1}}};
  while (!open.empty()) {
    const LatticeIndex at = open.front();
    open.pop_front();
    const Node node = nodes.at(at);
    for (const auto& [di, dj, axis] : kMoves) {
      const LatticeIndex next{at.first + di, at.second + dj};
      if (nodes.contains(next)) continue;
      const double sense = di + dj;
      const auto found = Find(node, sense * node.axes_px.col(axis));
      if (!found) continue;
      const Vector2d moved = candidates_[static_cast<std::size_t>(*found)].pixel -
                             candidates_[static_cast<std::size_t>(node.candidate)].pixel;
      Node grown{*found, node.axes_px};
      grown.axes_px.col(axis) = 0.5 * (grown.axes_px.col(axis) + sense * moved);
      taken_[static_cast<std::size_t>(*found)] = true;
      nodes.emplace(next, grown);
      open.push_back(next);
    }
  }
  std::map<LatticeIndex, Vector2d> pixels;
  for (const auto& [at, node] : nodes) {
    if (nodes.size() < kLeastToKeep && node.candidate != seed)
      taken_[static_cast<std::size_t>(node.candidate)] = false;
    pixels.emplace(at, candidates_[static_cast<std::size_t>(node.candidate)].pixel);
  }
  return pixels;
}

void UpdateBoxAndFit(CornerLattice* lattice) {
  Eigen::MatrixXd design(lattice->Count(), 3);
  Eigen::MatrixXd pixels(lattice->Count(), 2);
  lattice->first = lattice->last = lattice->pixels.begin()->first;
  int row = 0;
  for (const auto& [at, pixel] : lattice->pixels) {
    design.row(row) << 1, at.first, at.second;
    pixels.row(row++) = pixel.transpose();
    lattice->first.first = std::min(lattice->first.first, at.first);
    lattice->first.second = std::min(lattice->first.second, at.second);
    lattice->last.first = std::max(lattice->last.first, at.first);
    lattice->last.second = std::max(lattice->last.second, at.second);
  }
  const Eigen::MatrixXd solution = design.colPivHouseholderQr().solve(pixels);
  lattice->origin_px = solution.row(0).transpose();
  lattice->axes_px = solution.bottomRows(2).transpose();
  const Eigen::MatrixXd off = (pixels - design * solution) * lattice->axes_px.inverse().transpose();
  lattice->irregularity = std::sqrt(off.squaredNorm() / static_cast<double>(off.size()));
}

bool IsTooLarge(const CornerLattice& lattice, int columns, int rows) {
  const auto [short_side, long_side] = std::minmax({lattice.Width(), lattice.Height()});
  return short_side > std::min(columns, rows) || long_side > std::max(columns, rows);
}

// The least filled of the four end lines as (axis, coordinate) with its filling.
struct EndLine {
  int axis = 0, coordinate = 0;
  double filling = 2;
};

EndLine LeastFilledEnd(const CornerLattice& lattice) {
  EndLine least;
  for (const int axis : {0, 1})
    for (const bool at_last : {false, true}) {
      const LatticeIndex& end = at_last ? lattice.last : lattice.first;
      const int coordinate = axis == 0 ? end.first : end.second;
      int count = 0;
      for (const auto& entry : lattice.pixels)
        count += (axis == 0 ? entry.first.first : entry.first.second) == coordinate;
      const double filling =
          count / static_cast<double>(axis == 0 ? lattice.Height() : lattice.Width());
      if (filling < least.filling) least = {axis, coordinate, filling};
    }
  return least;
}

// The corners of `other` at their places on `lattice`; nothing when they do not fall on it.
std::optional<std::map<LatticeIndex, Vector2d>> PlacesOn(const CornerLattice& lattice,
                                                         const CornerLattice& other) {
  constexpr double kLargestOff = 0.2;  // of a square
  const Matrix2d to_lattice = lattice.axes_px.inverse();
  std::map<LatticeIndex, Vector2d> places;
  for (const auto& [at, pixel] : other.pixels) {
    const Vector2d place = to_lattice * (pixel - lattice.origin_px);
    const Vector2d nearest = place.array().round();
    if ((place - nearest).cwiseAbs().maxCoeff() > kLargestOff) return std::nullopt;
    const LatticeIndex index{static_cast<int>(nearest.x()), static_cast<int>(nearest.y())};
    if (lattice.pixels.contains(index) || !places.emplace(index, pixel).second) return std::nullopt;
  }
  return places;
}

}  // namespace

void JoinSeparated(int columns, int rows, std::vector<CornerLattice>* lattices) {
  constexpr int kLeastToJoin = 9;
  for (std::size_t i = 1; i < lattices->size();) {
    const CornerLattice& other = (*lattices)[i];
    CornerLattice joined = lattices->front();
    if (const auto places = PlacesOn(joined, other); places && other.Count() >= kLeastToJoin) {
      joined.pixels.insert(places->begin(), places->end());
      UpdateBoxAndFit(&joined);
      if (!IsTooLarge(joined, columns, rows)) {
        lattices->front() = std::move(joined);
        lattices->erase(lattices->begin() + static_cast<std::ptrdiff_t>(i));
        continue;
      }
    }
    ++i;
  }
}

std::vector<CornerLattice> FindLattices(const std::vector<SaddleCandidate>& candidates,
                                        double longest_side_px) {
  LatticeGrower grower(candidates, longest_side_px);
  std::vector<CornerLattice> lattices;
  for (int seed = 0; seed < static_cast<int>(candidates.size()); ++seed) {
    auto pixels = grower.GrowFrom(seed);
    if (!pixels || static_cast<int>(pixels->size()) < kLeastCorners) continue;
    CornerLattice lattice;
    lattice.pixels = std::move(*pixels);
    UpdateBoxAndFit(&lattice);
    lattices.push_back(std::move(lattice));
  }
  std::stable_sort(lattices.begin(), lattices.end(),
                   [](const auto& a, const auto& b) { return a.Count() > b.Count(); });
  return lattices;
}

void TrimSpuriousLines(int columns, int rows, CornerLattice* lattice) {
  constexpr double kLeastFilling = 0.4;
  while (IsTooLarge(*lattice, columns, rows)) {
    const EndLine end = LeastFilledEnd(*lattice);
    if (end.filling >= kLeastFilling || lattice->Count() <= kLeastCorners) return;
    std::erase_if(lattice->pixels, [&](const auto& entry) {
      return (end.axis == 0 ? entry.first.first : entry.first.second) == end.coordinate;
    });
    UpdateBoxAndFit(lattice);
  }
}

}  // namespace telestrain
