#include "calibration/bundle_terms.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/check.h"
#include "geometry/rotation.h"

namespace telestrain {
namespace {

constexpr double kMmPerUm = 1e-3;
constexpr double kTestedBow_mm = 0.010;  // prior of a bow that is tested: a loose bound

std::vector<double> BlockOfLens(const TelecentricLens& lens, double unit_px_per_mm) {
  std::vector<double> block{lens.magnification_px_per_mm / unit_px_per_mm, lens.aspect};
  for (std::size_t i = 0; i < 5; ++i)
    block.push_back(lens.distortion[i] * std::pow(kScaleRadius_mm, kRadiusPower[i]));
  block.push_back(lens.telecentricity_per_mm);
  return block;
}

TelecentricLens LensOfBlock(const double* block, double unit_px_per_mm,
                            const Eigen::Vector2d& center_px) {
  const LensNumbers numbers = NumbersOfLens(block, unit_px_per_mm, center_px);
  return {numbers.magnification_px_per_mm,
          center_px,
          {numbers.k1, numbers.k2, numbers.p1, numbers.p2, numbers.k3},
          numbers.aspect,
          numbers.telecentricity_per_mm};
}

std::size_t MostSeenPose(const CalibrationData& data) {
  std::vector<int> seen(data.images.size(), 0);
  for (const BoardData& board : data.boards) ++seen[static_cast<std::size_t>(board.image)];
  return static_cast<std::size_t>(std::max_element(seen.begin(), seen.end()) - seen.begin());
}

// One lens for all views, or one for each; from one to the other each starts from the mean.
std::vector<std::vector<double>> LensBlocks(const ArrayCalibration& array, double unit_px_per_mm,
                                            bool per_view) {
  std::vector<std::vector<double>> given;
  for (const TelecentricLens& lens : array.lenses)
    given.push_back(BlockOfLens(lens, unit_px_per_mm));
  const std::size_t wanted = per_view ? array.views.size() : 1;
  if (given.size() == wanted) return given;
  std::vector<double> mean(kLensSize, 0.0);
  for (const auto& block : given)
    for (std::size_t i = 0; i < kLensSize; ++i)
      mean[i] += block[i] / static_cast<double>(given.size());
  return std::vector<std::vector<double>>(wanted, mean);
}

std::vector<double> RotationAnd(const Eigen::Matrix3d& rotation, const Eigen::VectorXd& rest) {
  const Eigen::Vector3d w = LogRotation(rotation);
  std::vector<double> block{w.x(), w.y(), w.z()};
  block.insert(block.end(), rest.begin(), rest.end());
  return block;
}

}  // namespace

BundleBlocks::BundleBlocks(const CalibrationData& data, const ArrayState& start,
                           const BundleOptions& options)
    : unit_px_per_mm(start.array.lenses.front().magnification_px_per_mm),
      center_px(start.array.lenses.front().center_px),
      gauge_pose(MostSeenPose(data)),
      stage_axis(start.stage_axis_in_array) {
  const auto& [k1, k2, p1, p2, k3] = options.model.distortion;
  lens_free = {true, options.model.aspect, k1, k2, p1, p2, k3, options.model.telecentricity};
  storage_.reserve((kLensSize + kViewSize) * start.array.views.size() +
                   kPoseSize * data.images.size() + 1 +
                   kBoardShapeSize * data.target.boards.size() + kStageSize);
  GroupPoses(data);
  PlacePoses(start);
  for (const auto& lens : LensBlocks(start.array, unit_px_per_mm, options.model.per_view))
    lenses.push_back(Place(lens));
  for (const TelecentricView& view : start.array.views)
    views.push_back(Place(RotationAnd(view.Rotation(), view.offset_mm)));
  SetShapes(data, start, options);
  stage = Place({0, 0, start.stage_scale_relative});
  double largest_mm = 0;
  for (const PoseGroup& group : groups)
    for (const std::size_t image : group.images)
      largest_mm = std::max(largest_mm, std::abs(data.images[image].stage_mm -
                                                 data.images[group.images.front()].stage_mm));
  if (largest_mm > 0) stage_scale_sigma = options.stage_sigma_mm / largest_mm;
}

double* BundleBlocks::Place(const std::vector<double>& block) {
  TELESTRAIN_CHECK(storage_.size() + block.size() <= storage_.capacity(), "blocks must not move");
  storage_.insert(storage_.end(), block.begin(), block.end());
  return storage_.data() + storage_.size() - block.size();
}

void BundleBlocks::GroupPoses(const CalibrationData& data) {
  std::map<std::string, std::size_t> first_of_pose;
  for (std::size_t k = 0; k < data.images.size(); ++k) {
    const auto [at, is_first] = first_of_pose.try_emplace(data.images[k].pose, k);
    const bool moved = data.images[k].stage_mm != data.images[at->second].stage_mm;
    if (is_first || !moved) {
      place_of_image.push_back({groups.size(), 0});
      groups.emplace_back();
    } else {
      const std::size_t group = place_of_image[at->second].group;
      place_of_image.push_back({group, static_cast<int>(groups[group].images.size())});
    }
    groups[place_of_image.back().group].images.push_back(k);
  }
}

void BundleBlocks::PlacePoses(const ArrayState& start) {
  for (PoseGroup& group : groups) {
    std::vector<double> values;
    for (const std::size_t image : group.images) {
      const TargetPose& pose = start.poses[image];
      const auto block = RotationAnd(pose.array_from_target, pose.origin_in_array_mm);
      values.insert(values.end(), block.begin(), block.end());
    }
    group.values = Place(values);
  }
}

void BundleBlocks::SetShapes(const CalibrationData& data, const ArrayState& start,
                             const BundleOptions& options) {
  const TargetSpec& target = data.target;
  pitch = Place({start.target.pitch_relative});
  if (target.sigma_square_um > 0)
    pitch_sigma = target.sigma_square_um * kMmPerUm / (target.square_mm * (target.columns - 1));
  double bow_mm = target.flatness_um * kMmPerUm;
  if (options.estimate_bow) bow_mm = std::max(kTestedBow_mm, bow_mm);
  const double height_mm = target.coplanarity_um * kMmPerUm / std::sqrt(3.0);
  for (int i = 0; i < static_cast<int>(target.boards.size()); ++i) {
    const BoardShape s = start.target.Board(i);
    shapes.push_back(
        Place({s.shift_mm, s.height_mm, s.tilt_x_rad, s.tilt_y_rad, s.bow_x_mm, s.bow_y_mm}));
    std::array<double, kBoardShapeSize> sigmas{0, 0, 0, 0, bow_mm, bow_mm};
    if (i > 0) {
      const BoardGeometry geometry = GeometryOfBoard(target, i);
      sigmas[0] = target.sigma_separation_um * kMmPerUm;
      sigmas[1] = height_mm;
      sigmas[2] = height_mm / geometry.half_height_mm;
      sigmas[3] = height_mm / geometry.half_width_mm;
    }
    shape_sigmas.push_back(sigmas);
  }
}

ArrayState BundleBlocks::State(const ArrayState& start, const LensModel& model) const {
  ArrayState state = start;
  state.array.model = model;
  state.array.lenses.clear();
  for (const double* lens : lenses)
    state.array.lenses.push_back(LensOfBlock(lens, unit_px_per_mm, center_px));
  for (std::size_t i = 0; i < views.size(); ++i) {
    const double* view = views[i];
    state.array.views[i].axes_in_array = ExpRotation({view[0], view[1], view[2]}).topRows<2>();
    state.array.views[i].offset_mm = {view[3], view[4]};
  }
  for (std::size_t k = 0; k < place_of_image.size(); ++k) {
    const PosePlace& place = place_of_image[k];
    const double* pose = groups[place.group].values + kPoseSize * place.slot;
    state.poses[k].array_from_target = ExpRotation({pose[0], pose[1], pose[2]});
    state.poses[k].origin_in_array_mm = {pose[3], pose[4], pose[5]};
  }
  state.target.pitch_relative = *pitch;
  state.target.boards.clear();
  for (const double* s : shapes)
    state.target.boards.push_back({s[0], s[1], s[2], s[3], s[4], s[5]});
  state.stage_axis_in_array = stage_axis.At(stage);
  state.stage_scale_relative = stage[2];
  return state;
}

void BundleBlocks::AppendArray(const ArrayState& start, std::vector<GlobalBlock>& globals) const {
  const auto name_of = [&](std::size_t view) { return start.array.views[view].name + "."; };
  for (std::size_t i = 0; i < lenses.size(); ++i) {
    GlobalBlock block{GlobalBlock::kLens, lenses[i], {}, {}, {unit_px_per_mm, 1}};
    for (const char* what : {"magnification_px_per_mm", "aspect", "k1_per_mm2", "k2_per_mm4",
                             "p1_per_mm", "p2_per_mm", "k3_per_mm6", "telecentricity_per_mm"})
      block.names.push_back((lenses.size() == 1 ? "" : name_of(i)) + what);
    block.free.assign(lens_free.begin(), lens_free.end());
    for (const int power : kRadiusPower) block.unit.push_back(1 / std::pow(kScaleRadius_mm, power));
    block.unit.push_back(1);
    globals.push_back(std::move(block));
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    GlobalBlock block{GlobalBlock::kView,
                      views[i],
                      {},
                      std::vector<bool>(kViewSize, true),
                      std::vector<double>(kViewSize, 1)};
    for (const char* what :
         {"rotation_x_rad", "rotation_y_rad", "rotation_z_rad", "offset_x_mm", "offset_y_mm"})
      block.names.push_back(name_of(i) + what);
    globals.push_back(std::move(block));
  }
}

bool IsAdjusted(const GlobalBlock& block, std::size_t index) {
  constexpr std::size_t kFirstBow = 4;
  return block.free[index] && (block.kind != GlobalBlock::kTarget || index >= kFirstBow);
}

void BundleBlocks::AppendTarget(const TargetSpec& target, std::vector<GlobalBlock>& globals) const {
  globals.push_back(
      {GlobalBlock::kTarget, pitch, {"target.pitch_relative"}, {pitch_sigma > 0}, {1}});
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    GlobalBlock block{GlobalBlock::kTarget, shapes[i], {}, {}, std::vector<double>(6, 1)};
    for (const char* what :
         {"shift_mm", "height_mm", "tilt_x_rad", "tilt_y_rad", "bow_x_mm", "bow_y_mm"})
      block.names.push_back("target." + target.boards[i].group + "." + what);
    for (const double sigma : shape_sigmas[i]) block.free.push_back(sigma > 0);
    globals.push_back(std::move(block));
  }
  if (stage_scale_sigma > 0)
    globals.push_back({GlobalBlock::kStage,
                       stage,
                       {"stage.tilt_x_rad", "stage.tilt_y_rad", "stage.scale_relative"},
                       {true, true, true},
                       {1, 1, 1}});
}

std::vector<GlobalBlock> BundleBlocks::Globals(const CalibrationData& data,
                                               const ArrayState& start) const {
  std::vector<GlobalBlock> globals;
  AppendArray(start, globals);
  AppendTarget(data.target, globals);
  return globals;
}

namespace {

GramPlan PlanOf(const BundleBlocks& blocks, const BundleOptions& options) {
  GramPlan plan;
  plan.lens_free = blocks.lens_free;
  plan.robust_sigmas = options.robust_sigmas;
  plan.depth = options.model.telecentricity;
  for (const double* lens : blocks.lenses) plan.depth = plan.depth || lens[7] != 0;
  for (std::size_t i = 0; i < blocks.shapes.size(); ++i)
    for (const std::size_t bow : {4u, 5u})
      plan.curved = plan.curved || blocks.shape_sigmas[i][bow] > 0 || blocks.shapes[i][bow] != 0;
  return plan;
}

void AddPriors(BundleBlocks& blocks, std::vector<BundleTerm>& terms) {
  const auto add = [&](BundleTerm::Kind kind, const std::vector<double>& sigmas, double* block) {
    auto prior = std::make_unique<PriorResidual>(sigmas);
    if (prior->num_residuals() > 0) terms.push_back({kind, std::move(prior), {block}});
  };
  add(BundleTerm::kPrior, {blocks.pitch_sigma}, blocks.pitch);
  for (std::size_t i = 0; i < blocks.shapes.size(); ++i)
    add(BundleTerm::kPrior, {blocks.shape_sigmas[i].begin(), blocks.shape_sigmas[i].end()},
        blocks.shapes[i]);
  add(BundleTerm::kStage, {0, 0, blocks.stage_scale_sigma}, blocks.stage);
}

void AddStageMoves(const CalibrationData& data, double sigma_mm, BundleBlocks& blocks,
                   std::vector<BundleTerm>& terms) {
  for (PoseGroup& group : blocks.groups) {
    StageResidual::Move move;
    move.poses = static_cast<int>(group.images.size());
    move.sigma_mm = sigma_mm;
    for (move.second = 1; move.second < move.poses; ++move.second) {
      move.travel_mm = data.images[group.images[static_cast<std::size_t>(move.second)]].stage_mm -
                       data.images[group.images.front()].stage_mm;
      terms.push_back({BundleTerm::kStage,
                       std::make_unique<StageResidual>(blocks.stage_axis, move),
                       {group.values, blocks.stage}});
    }
  }
}

}  // namespace

std::vector<BundleTerm> MakeTerms(const CalibrationData& data, const ArrayState& start,
                                  const BundleOptions& options, BundleBlocks& blocks) {
  std::vector<BundleTerm> terms;
  terms.reserve(data.boards.size() + data.images.size() + blocks.shapes.size() + 2);
  BoardModel model;
  model.plan = PlanOf(blocks, options);
  model.unit_px_per_mm = blocks.unit_px_per_mm;
  model.center_px = blocks.center_px;
  for (const BoardData& board : data.boards) {
    const auto view = static_cast<std::size_t>(board.view);
    const PosePlace& place = blocks.place_of_image[static_cast<std::size_t>(board.image)];
    PoseGroup& group = blocks.groups[place.group];
    model.depth_sense = start.array.views[view].depth_sense;
    model.depth_offset_mm = start.array.views[view].depth_offset_mm;
    model.pose = place.slot;
    model.poses = static_cast<int>(group.images.size());
    double* lens = blocks.lenses.size() == 1 ? blocks.lenses.front() : blocks.lenses[view];
    terms.push_back({BundleTerm::kCorners,
                     std::make_unique<BoardResidual>(board, model),
                     {lens, blocks.views[view], group.values, blocks.pitch,
                      blocks.shapes.at(static_cast<std::size_t>(board.geometry.board))}});
  }
  AddPriors(blocks, terms);
  AddStageMoves(data, options.stage_sigma_mm, blocks, terms);
  return terms;
}

}  // namespace telestrain
