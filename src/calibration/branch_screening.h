#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace telestrain {

// A board with both rotations that its view cannot tell apart, and the one that was chosen.
struct BranchedBoard {
  int image = 0;
  int view = 0;
  std::array<Eigen::Matrix3d, 2> camera_from_target;
  int branch = 0;
};

// The paper's Fig. 5. Over the images the rotation between two views is constant when the chosen
// branch is right in both (or wrong in both: the mirror image), and varies when it is right in one
// only. Spreads are rms angles about the mean.
struct BranchScreening {
  int view_pairs = 0;               // that share three images or more
  double chosen_spread_deg = 0;     // largest over the pairs, as chosen (and all flipped: the same)
  double mixed_spread_deg = 0;      // smallest over the pairs, one of the two views flipped
  std::array<int, 2> worst_pair{};  // views of the largest chosen spread
  // Whether the images tell the combinations apart: the mixed spread is more than ten times the
  // chosen one. They do not when the target was tilted alike in all of them.
  bool IsDecisive() const { return view_pairs > 0 && mixed_spread_deg > 10 * chosen_spread_deg; }
};

BranchScreening ScreenBranches(const std::vector<BranchedBoard>& boards);

}  // namespace telestrain
