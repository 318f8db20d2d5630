#pragma once

#include <ceres/cost_function.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "calibration/board_residual.h"
#include "calibration/bundle_adjustment.h"
#include "calibration/prior_residuals.h"

// Private to the calibration module: the parameter blocks of the adjustment and its terms.
namespace telestrain {

// Poses that the stage connects share a block, so that all pose blocks are independent of each
// other and can be eliminated one by one.
struct PoseGroup {
  std::vector<std::size_t> images;
  double* values = nullptr;  // 6 per image
  std::size_t Size() const { return images.size() * kPoseSize; }
};
struct PosePlace {
  std::size_t group = 0;
  int slot = 0;
};

// A block of global parameters, with what its numbers are called and which of them are estimated.
struct GlobalBlock {
  enum Kind { kLens, kView, kTarget, kStage };
  Kind kind = kLens;
  double* values = nullptr;
  std::vector<std::string> names;
  std::vector<bool> free;
  std::vector<double> unit;  // of the named quantity per unit of the block's number
};

// Whether the adjustment moves a free number of a block. Of the target it moves only the bows,
// which every image shows. Pitch, distance, height and tilts hardly show in any residual: a
// thousandth of a pixel of unmodelled error would move them by more than their certificates allow.
// They keep their certified values, and their uncertainty is carried into every covariance
// (MODEL.md 5).
bool IsAdjusted(const GlobalBlock& block, std::size_t index);

// The numbers that Ceres moves. Not copied: terms point into it. All blocks lie in one piece of
// memory in a fixed order, because Ceres sorts them by their addresses: the sums, and so the bytes
// of the result, must not depend on where the heap happens to put them.
class BundleBlocks {
 public:
  BundleBlocks(const CalibrationData& data, const ArrayState& start, const BundleOptions& options);
  BundleBlocks(const BundleBlocks&) = delete;
  BundleBlocks& operator=(const BundleBlocks&) = delete;

  ArrayState State(const ArrayState& start, const LensModel& model) const;
  std::vector<GlobalBlock> Globals(const CalibrationData& data, const ArrayState& start) const;

  double unit_px_per_mm = 1;  // what a relative magnification of 1 means
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  std::vector<double*> lenses;  // kLensSize each
  std::array<bool, kLensSize> lens_free{};
  std::vector<double*> views;  // kViewSize each
  std::vector<PoseGroup> groups;
  std::vector<PosePlace> place_of_image;
  std::size_t gauge_pose = 0;
  double* pitch = nullptr;
  double pitch_sigma = 0;       // 0: fixed, like the following ones
  std::vector<double*> shapes;  // kBoardShapeSize each
  std::vector<std::array<double, kBoardShapeSize>> shape_sigmas;
  StageAxis stage_axis;
  double* stage = nullptr;       // kStageSize
  double stage_scale_sigma = 0;  // 0: no travel, the stage block is not used

 private:
  void AppendArray(const ArrayState& start, std::vector<GlobalBlock>& globals) const;
  void AppendTarget(const TargetSpec& target, std::vector<GlobalBlock>& globals) const;
  double* Place(const std::vector<double>& block);
  void GroupPoses(const CalibrationData& data);
  void PlacePoses(const ArrayState& start);
  void SetShapes(const CalibrationData& data, const ArrayState& start,
                 const BundleOptions& options);
  std::vector<double> storage_;  // never reallocated
};

// A term of the cost and the blocks that it depends on.
struct BundleTerm {
  enum Kind { kCorners, kPrior, kStage };
  Kind kind = kCorners;
  std::unique_ptr<ceres::CostFunction> residual;
  std::vector<double*> blocks;
};

std::vector<BundleTerm> MakeTerms(const CalibrationData& data, const ArrayState& start,
                                  const BundleOptions& options, BundleBlocks& blocks);

}  // namespace telestrain
