#include "calibration/weak_input.h"

#include <algorithm>
#include <cmath>

#include "base/numbers.h"
#include "geometry/rotation.h"

namespace telestrain {
namespace {

constexpr const char* kStart = "the images do not determine the calibration: ";
constexpr double kDegPerRad = 57.29577951308232;
// Poses nearer than both are the same pose: what a stage or a hand repeats.
constexpr double kSameTurn_deg = 0.05, kSamePlace_mm = 0.02;
constexpr int kLeastDifferentPoses = 3;
// A view that never sees the target tilted by more than this cannot tell tilt from scale.
constexpr double kLeastTilt_deg = 1.0;
// Orientations within this of each other are one orientation.
constexpr double kLeastTurn_deg = 0.3;

bool IsSamePose(const TargetPose& a, const TargetPose& b) {
  return kDegPerRad * AngleBetween_rad(a.array_from_target, b.array_from_target) < kSameTurn_deg &&
         (a.origin_in_array_mm - b.origin_in_array_mm).norm() < kSamePlace_mm;
}

int DifferentPoses(const std::vector<TargetPose>& poses) {
  std::vector<TargetPose> different;
  for (const TargetPose& pose : poses)
    if (std::none_of(different.begin(), different.end(),
                     [&](const TargetPose& other) { return IsSamePose(pose, other); }))
      different.push_back(pose);
  return static_cast<int>(different.size());
}

double LargestTurn_deg(const std::vector<TargetPose>& poses) {
  double largest = 0;
  for (const TargetPose& pose : poses)
    largest = std::max(largest,
                       AngleBetween_rad(pose.array_from_target, poses.front().array_from_target));
  return kDegPerRad * largest;
}

// Largest angle between the target's normal and the viewing direction over the images of a view.
double LargestTilt_deg(const Session& session, const CalibrationData& data,
                       const std::vector<TargetPose>& poses, std::size_t view) {
  const Eigen::Vector3d axis = session.views[view].axis_in_array.normalized();
  double largest = 0;
  for (const BoardData& board : data.boards) {
    if (board.view != static_cast<int>(view)) continue;
    const Eigen::Vector3d normal =
        poses[static_cast<std::size_t>(board.image)].array_from_target.col(2);
    largest = std::max(largest, std::acos(std::min(1.0, std::abs(normal.dot(axis)))));
  }
  return kDegPerRad * largest;
}

std::string Join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string FacingViews(const Session& session, const CalibrationData& data,
                        const std::vector<TargetPose>& poses) {
  std::vector<std::string> facing;
  for (std::size_t view = 0; view < session.views.size(); ++view)
    if (LargestTilt_deg(session, data, poses, view) < kLeastTilt_deg)
      facing.push_back(session.views[view].name);
  return Join(facing);
}

}  // namespace

Status RequireDifferentPoses(const std::vector<TargetPose>& poses) {
  const int different = DifferentPoses(poses);
  if (different >= kLeastDifferentPoses) return {};
  return EstimationFailed(
      kStart + ("the " + std::to_string(poses.size())) + " usable images show " +
      CountText(static_cast<std::size_t>(different), "different pose") +
      " of the target; take at least 6 that differ in tilt (some degrees) and place");
}

std::string ExplainWeakInput(const Session& session, const CalibrationData& data,
                             const std::vector<TargetPose>& poses, const std::string& otherwise) {
  const std::string start = kStart;
  if (const Status status = RequireDifferentPoses(poses); !status) return status.error().message;
  if (const std::string facing = FacingViews(session, data, poses); !facing.empty())
    return start + "the target faces view " + facing + " squarely in every image (tilt below " +
           FormatFixed(kLeastTilt_deg, 0) +
           " deg), so that its tilt cannot be told from the scale; tilt the target by 10 deg and "
           "more in different directions";
  if (const double turn = LargestTurn_deg(poses); turn < kLeastTurn_deg)
    return start + "the target has the same orientation in all images (within " +
           FormatFixed(turn, 2) + " deg); tilt it by some degrees in different directions";
  return otherwise;
}

}  // namespace telestrain
