#include "calibration/calibration_data.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <map>
#include <set>

namespace telestrain {
namespace {

int ViewIndex(const Session& session, const std::string& name) {
  for (std::size_t i = 0; i < session.views.size(); ++i)
    if (session.views[i].name == name) return static_cast<int>(i);
  return -1;
}

Eigen::Matrix2d Whitening(const Eigen::Matrix2d& covariance_px2, double floor_px) {
  const Eigen::Matrix2d padded = covariance_px2 + floor_px * floor_px * Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d lower = padded.llt().matrixL();
  return lower.inverse();
}

// The index of the group's sub-board and its geometry.
BoardGeometry GeometryOfGroup(const TargetSpec& target, const std::string& group) {
  const SubBoard* sub_board = target.FindBoard(group);
  TELESTRAIN_CHECK(sub_board != nullptr, "a checked session has a board for every group");
  return GeometryOfBoard(target, static_cast<int>(sub_board - target.boards.data()));
}

BoardData MakeBoard(const BoardObservation& observation, const TargetSpec& target,
                    const BoardGeometry& geometry, double floor_px) {
  BoardData board;
  board.geometry = geometry;
  for (std::size_t i = 0; i < observation.corners.size(); ++i)
    if (observation.corners[i]) board.corner.push_back(static_cast<int>(i));
  const auto count = static_cast<Eigen::Index>(board.corner.size());
  board.corners_in_board_mm.resize(2, count);
  board.pixels.resize(2, count);
  board.whitening.reserve(board.corner.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    const int corner = board.corner[static_cast<std::size_t>(i)];
    const ImagePoint& point = *observation.corners[static_cast<std::size_t>(corner)];
    board.corners_in_board_mm.col(i) =
        Eigen::Vector2d((corner % target.columns - 0.5 * (target.columns - 1)) * target.square_mm,
                        (corner / target.columns - 0.5 * (target.rows - 1)) * target.square_mm);
    board.pixels.col(i) = point.pixel;
    board.whitening.push_back(Whitening(point.covariance_px2, floor_px));
  }
  board.corners_in_target_mm = CornersOfBoard(geometry, board.corners_in_board_mm, {});
  return board;
}

std::vector<int> SeenCorners(const BoardObservation& observation) {
  std::vector<int> seen;
  for (std::size_t i = 0; i < observation.corners.size(); ++i)
    if (observation.corners[i]) seen.push_back(static_cast<int>(i));
  return seen;
}

}  // namespace

bool GiveAnAffineImage(const std::vector<int>& corners, int grid_columns) {
  constexpr std::size_t kLeastCorners = 4;  // three make an affine image; the fourth checks it
  if (corners.size() < kLeastCorners) return false;
  const auto place = [&](int corner) {
    return Eigen::Vector2i(corner % grid_columns, corner / grid_columns);
  };
  const Eigen::Vector2i first = place(corners[0]), along = place(corners[1]) - first;
  return std::any_of(corners.begin() + 2, corners.end(), [&](int corner) {
    const Eigen::Vector2i across = place(corner) - first;
    return along.x() * across.y() != along.y() * across.x();
  });
}

void BoardData::RemoveCorners(const std::vector<bool>& remove) {
  Eigen::Index kept = 0;
  for (std::size_t i = 0; i < remove.size(); ++i) {
    if (remove[i]) continue;
    corner[static_cast<std::size_t>(kept)] = corner[i];
    whitening[static_cast<std::size_t>(kept)] = whitening[i];
    corners_in_board_mm.col(kept) = corners_in_board_mm.col(static_cast<Eigen::Index>(i)).eval();
    corners_in_target_mm.col(kept) = corners_in_target_mm.col(static_cast<Eigen::Index>(i)).eval();
    pixels.col(kept) = pixels.col(static_cast<Eigen::Index>(i)).eval();
    ++kept;
  }
  corner.resize(static_cast<std::size_t>(kept));
  whitening.resize(static_cast<std::size_t>(kept));
  corners_in_board_mm.conservativeResize(2, kept);
  corners_in_target_mm.conservativeResize(3, kept);
  pixels.conservativeResize(2, kept);
}

Eigen::Index CalibrationData::CornerCount() const {
  Eigen::Index count = 0;
  for (const BoardData& board : boards) count += board.Count();
  return count;
}

void CalibrationData::DropUndeterminedImages(const Session& session) {
  // Of two views at an angle phi the information on the depth is 1 - cos(phi); 0.02 is 11 degrees.
  constexpr double kMinDepthInformation = 0.02;
  std::map<int, Eigen::Matrix3d> information;
  for (const BoardData& board : boards) {
    const auto axes =
        session.NominalTelecentricView(session.views[static_cast<std::size_t>(board.view)])
            .axes_in_array;
    information.try_emplace(board.image, Eigen::Matrix3d::Zero()).first->second +=
        axes.transpose() * axes;
  }
  const auto is_determined = [&](int image) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(information.at(image));
    return solver.eigenvalues()(0) > kMinDepthInformation;
  };
  for (const BoardData& board : boards) {
    if (is_determined(board.image)) continue;
    rejected.push_back({images[static_cast<std::size_t>(board.image)].image,
                        session.views[static_cast<std::size_t>(board.view)].name,
                        "no second view from another direction sees the target in this image: the "
                        "depth of the pose is not determined",
                        static_cast<int>(board.Count())});
  }
  std::erase_if(boards, [&](const BoardData& b) { return !is_determined(b.image); });
  std::map<int, int> new_index;
  std::vector<CalibrationImage> kept;
  for (BoardData& board : boards) {
    const auto [at, is_new] = new_index.try_emplace(board.image, static_cast<int>(kept.size()));
    if (is_new) kept.push_back(images[static_cast<std::size_t>(board.image)]);
    board.image = at->second;
  }
  images = std::move(kept);
}

void CullRegions(const Session& session, const std::vector<PixelRegion>& regions,
                 CalibrationData& data) {
  const auto is_inside = [&](const Eigen::Vector2d& pixel) {
    return std::any_of(regions.begin(), regions.end(), [&](const PixelRegion& r) {
      return pixel.x() >= r.x - 0.5 && pixel.x() < r.x + r.width - 0.5 && pixel.y() >= r.y - 0.5 &&
             pixel.y() < r.y + r.height - 0.5;
    });
  };
  for (BoardData& board : data.boards) {
    std::vector<bool> remove;
    for (Eigen::Index i = 0; i < board.Count(); ++i)
      remove.push_back(is_inside(board.pixels.col(i)));
    auto count = static_cast<int>(std::count(remove.begin(), remove.end(), true));
    if (count == 0) continue;
    std::vector<int> kept;
    for (std::size_t i = 0; i < remove.size(); ++i)
      if (!remove[i]) kept.push_back(board.corner[i]);
    const bool whole_board = !GiveAnAffineImage(kept, data.target.columns);
    if (whole_board) remove.assign(remove.size(), true), count = static_cast<int>(board.Count());
    data.rejected.push_back({data.images[static_cast<std::size_t>(board.image)].image,
                             session.views[static_cast<std::size_t>(board.view)].name,
                             kCulledReason, count, whole_board});
    board.RemoveCorners(remove);
  }
  std::erase_if(data.boards, [](const BoardData& board) { return board.Count() == 0; });
  data.DropUndeterminedImages(session);
}

Result<CalibrationData> CollectCalibrationData(const Session& session,
                                               const std::vector<BoardObservation>& observations,
                                               double floor_px) {
  CalibrationData data;
  data.images = session.calibration_images;
  data.target = session.target;
  data.floor_px = floor_px;
  std::map<std::string, int> image_index;
  for (std::size_t i = 0; i < data.images.size(); ++i)
    image_index[data.images[i].image] = static_cast<int>(i);
  for (const BoardObservation& observation : observations) {
    const int view = ViewIndex(session, observation.view);
    const auto image = image_index.find(observation.image);
    if (view < 0 || image == image_index.end())
      return BadInput("corners.vnl: '" + observation.image + "#" + observation.view +
                      "' is not an image and view of the session; detect the corners again with "
                      "'telestrain detect'");
    if (!observation.rejected_because.empty()) {
      data.rejected.push_back({observation.image, observation.view, observation.rejected_because});
      continue;
    }
    const std::vector<int> seen = SeenCorners(observation);
    if (!GiveAnAffineImage(seen, session.target.columns)) {
      data.rejected.push_back({observation.image, observation.view,
                               "fewer than four corners, or all on one line",
                               static_cast<int>(seen.size())});
      continue;
    }
    const std::string& group = session.views[static_cast<std::size_t>(view)].group;
    data.boards.push_back(
        MakeBoard(observation, session.target, GeometryOfGroup(session.target, group), floor_px));
    data.boards.back().image = image->second;
    data.boards.back().view = view;
  }
  std::stable_sort(data.boards.begin(), data.boards.end(), [](const auto& a, const auto& b) {
    return std::pair(a.image, a.view) < std::pair(b.image, b.view);
  });
  data.DropUndeterminedImages(session);
  return data;
}

}  // namespace telestrain
