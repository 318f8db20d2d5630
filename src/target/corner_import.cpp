#include "target/corner_import.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>

#include "base/numbers.h"
#include "target/corners_file.h"

namespace telestrain {
namespace {

// Corners of a view lie in its region; a detector that was given a cut-out counts from elsewhere.
Status CheckPlaces(const Session& session, const std::string& where,
                   const BoardObservation& block) {
  for (const NominalView& view : session.views) {
    if (view.name != block.view) continue;
    const PixelRegion& r = view.region;
    for (const auto& corner : block.corners) {
      if (!corner) continue;
      const Eigen::Vector2d& p = corner->pixel;
      if (p.x() >= r.x - 0.5 && p.y() >= r.y - 0.5 && p.x() <= r.x + r.width - 0.5 &&
          p.y() <= r.y + r.height - 0.5)
        continue;
      return BadInput(where + "the corner (" + FormatFixed(p.x(), 2) + ", " +
                      FormatFixed(p.y(), 2) + ") of '" + block.image + "#" + block.view +
                      "' lies outside region_px of the view (x " + std::to_string(r.x) + " to " +
                      std::to_string(r.x + r.width - 1) + ", y " + std::to_string(r.y) + " to " +
                      std::to_string(r.y + r.height - 1) +
                      "); coordinates count from the corner of the whole sensor");
    }
  }
  return {};
}

// A block of an imported table must belong to the session.
Status CheckBlock(const Session& session, const std::string& file, const BoardObservation& block) {
  std::string images, views;
  bool has_image = false, has_view = false;
  for (const auto& pose : session.calibration_images) {
    has_image |= pose.image == block.image;
    images += (images.empty() ? "" : ", ") + pose.image;
  }
  for (const NominalView& view : session.views) {
    has_view |= view.name == block.view;
    views += (views.empty() ? "" : ", ") + view.name;
  }
  const std::string where = file + ":" + std::to_string(block.line) + ": ";
  if (!has_image)
    return BadInput(where + "'" + block.image +
                    "' is not a calibration image of the session; it has " + images);
  if (!has_view)
    return BadInput(where + "'" + block.view + "' is not a view of the session; it has " + views);
  return CheckPlaces(session, where, block);
}

// Least-squares affine map from a grid's columns and rows to its pixels.
struct GridFit {
  Eigen::Matrix2d pixels_from_grid = Eigen::Matrix2d::Zero();
  double rms_px = 0;
};

// `by_column`: the block's lines run down the columns first.
GridFit FitGrid(const BoardObservation& block, const TargetSpec& target, bool by_column) {
  Eigen::MatrixXd left(block.corners.size(), 3), right(block.corners.size(), 2);
  Eigen::Index n = 0;
  for (std::size_t i = 0; i < block.corners.size(); ++i) {
    if (!block.corners[i]) continue;
    const int at = static_cast<int>(i);
    const int column = by_column ? at / target.rows : at % target.columns;
    const int row = by_column ? at % target.rows : at / target.columns;
    left.row(n) << column, row, 1;
    right.row(n++) = block.corners[i]->pixel.transpose();
  }
  left.conservativeResize(n, 3);
  right.conservativeResize(n, 2);
  const Eigen::MatrixXd fit = left.colPivHouseholderQr().solve(right);
  const double squares = (left * fit - right).squaredNorm();
  return {fit.topRows<2>().transpose(), std::sqrt(squares / std::max(1.0, 2.0 * double(n)))};
}

// How a block's corners are told to run, against the session: the axes of the target lie within
// 45 deg of the array's, so each must run in the image as the nominal view shows the array's.
struct OrderVotes {
  int blocks = 0, by_column = 0, x_reversed = 0, y_reversed = 0;
};

void Vote(const Session& session, const BoardObservation& block, OrderVotes& votes) {
  constexpr double kMuchBetter = 0.3;  // a grid read the wrong way fits no affine map at all
  const auto view = std::find_if(session.views.begin(), session.views.end(),
                                 [&](const auto& v) { return v.name == block.view; });
  const SubBoard* board =
      view == session.views.end() ? nullptr : session.target.FindBoard(view->group);
  const auto seen = std::count_if(block.corners.begin(), block.corners.end(),
                                  [](const auto& corner) { return corner.has_value(); });
  if (board == nullptr || seen < session.target.CornerCount() / 2) return;
  GridFit fit = FitGrid(block, session.target, false);
  const GridFit other = FitGrid(block, session.target, true);
  const bool by_column = other.rms_px < kMuchBetter * fit.rms_px;
  if (by_column) fit = other;
  const Eigen::Rotation2Dd target_from_board(board->rotation_rad);
  const Eigen::Matrix2d nominal =
      session.NominalTelecentricView(*view).axes_in_array.leftCols<2>() *
      target_from_board.toRotationMatrix();
  ++votes.blocks;
  votes.by_column += by_column;
  votes.x_reversed += fit.pixels_from_grid.col(0).dot(nominal.col(0)) < 0;
  votes.y_reversed += fit.pixels_from_grid.col(1).dot(nominal.col(1)) < 0;
}

// Fails when most blocks run in another order than the format's.
Status CheckOrder(const Session& session, const std::string& file,
                  const std::vector<BoardObservation>& blocks) {
  OrderVotes votes;
  for (const BoardObservation& block : blocks) Vote(session, block, votes);
  const auto most = [&](int count) { return 2 * count > votes.blocks; };
  std::string wrong;
  const auto add = [&](bool is_wrong, const char* text) {
    if (is_wrong) wrong += (wrong.empty() ? "" : ", ") + std::string(text);
  };
  add(most(votes.by_column), "down the columns first (y fastest)");
  add(most(votes.x_reversed), "against the target's x");
  add(most(votes.y_reversed), "against the target's y");
  if (wrong.empty()) return {};
  return BadInput(file + ": by the nominal views the corners of most blocks run " + wrong +
                  "; write each block with x of the target running fastest, from the corner with "
                  "the smallest x and y of the target, or mend [[view]] in session.toml");
}

}  // namespace

Result<Detection> ImportCorners(const Session& session, const std::filesystem::path& corners_vnl,
                                Console& console) {
  TELESTRAIN_ASSIGN_OR_RETURN(const auto blocks,
                              ReadCornersVnl(corners_vnl, session.target.CornerCount()));
  if (blocks.empty())
    return BadInput(corners_vnl.string() +
                    ": holds no corners; write a line 'image#view x y level' for every corner");
  std::map<std::string, const BoardObservation*> by_name;
  for (const BoardObservation& block : blocks) {
    TELESTRAIN_RETURN_IF_ERROR(CheckBlock(session, corners_vnl.string(), block));
    if (!by_name.emplace(block.image + "#" + block.view, &block).second)
      return BadInput(corners_vnl.string() + ": '" + block.image + "#" + block.view +
                      "' has two blocks; keep one");
  }
  TELESTRAIN_RETURN_IF_ERROR(CheckOrder(session, corners_vnl.string(), blocks));
  Detection detection;
  TELESTRAIN_ASSIGN_OR_RETURN(detection.crosses, DetectCrosses(session, console));
  for (const auto& pose : session.calibration_images)
    for (const NominalView& view : session.views) {
      const auto found = by_name.find(pose.image + "#" + view.name);
      BoardObservation board{pose.image, view.name, {}, "not in " + corners_vnl.string(), 0};
      if (found != by_name.end()) board = *found->second;
      for (auto& corner : board.corners)
        if (corner) corner->covariance_px2 *= kForeignSigma_px * kForeignSigma_px;
      detection.boards.push_back(std::move(board));
    }
  return detection;
}

}  // namespace telestrain
