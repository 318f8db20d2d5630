#include "calibration/branch_screening.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/rotation.h"

namespace telestrain {
namespace {

constexpr double kDegPerRad = 57.29577951308232;
constexpr std::size_t kLeastImages = 3;

double Spread_deg(const std::vector<Eigen::Matrix3d>& rotations) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Eigen::Matrix3d& rotation : rotations) sum += rotation;
  const Eigen::Matrix3d mean = NearestRotation(sum);
  double squares = 0;
  for (const Eigen::Matrix3d& rotation : rotations)
    squares += std::pow(AngleBetween_rad(rotation, mean), 2);
  return kDegPerRad * std::sqrt(squares / static_cast<double>(rotations.size()));
}

using BoardPair = std::pair<const BranchedBoard*, const BranchedBoard*>;

// Spread of the rotation from the first to the second view with their branches flipped or not.
double Spread_deg(const std::vector<BoardPair>& pairs, bool flip_first, bool flip_second) {
  const auto rotation = [](const BranchedBoard& board, bool flip) -> const Eigen::Matrix3d& {
    return board
        .camera_from_target[static_cast<std::size_t>(flip ? 1 - board.branch : board.branch)];
  };
  std::vector<Eigen::Matrix3d> second_from_first;
  for (const auto& [first, second] : pairs)
    second_from_first.push_back(rotation(*second, flip_second) *
                                rotation(*first, flip_first).transpose());
  return Spread_deg(second_from_first);
}

}  // namespace

BranchScreening ScreenBranches(const std::vector<BranchedBoard>& boards) {
  std::map<std::array<int, 2>, std::vector<BoardPair>> of_views;
  std::map<int, std::vector<const BranchedBoard*>> of_image;
  for (const BranchedBoard& board : boards) of_image[board.image].push_back(&board);
  for (const auto& [image, members] : of_image)
    for (const BranchedBoard* a : members)
      for (const BranchedBoard* b : members)
        if (a->view < b->view) of_views[{a->view, b->view}].push_back({a, b});
  BranchScreening screening;
  screening.mixed_spread_deg = 180;
  for (const auto& [views, pairs] : of_views) {
    if (pairs.size() < kLeastImages) continue;
    ++screening.view_pairs;
    const double chosen = Spread_deg(pairs, false, false);
    if (chosen > screening.chosen_spread_deg) {
      screening.chosen_spread_deg = chosen;
      screening.worst_pair = views;
    }
    screening.mixed_spread_deg =
        std::min({screening.mixed_spread_deg, Spread_deg(pairs, true, false),
                  Spread_deg(pairs, false, true)});
  }
  if (screening.view_pairs == 0) screening.mixed_spread_deg = 0;
  return screening;
}

}  // namespace telestrain
