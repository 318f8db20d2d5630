#include "measurement/stereo_matching.h"

#include <cmath>
#include <optional>

#include "measurement/triangulation.h"

namespace telestrain {
namespace {

constexpr int kBorder_px = 8;            // beyond the subset: room for the interpolation
constexpr double kMaxEpipolar_px = 1.5;  // of a match; larger is a wrong match

// A node that both views can show, and where the pipe's geometry puts it in the second one.
struct GridNode {
  int column = 0, row = 0;
  Eigen::Vector2i center_px;
  Eigen::Vector2d second_px;
  Eigen::Matrix2d second_from_first;  // local linear map
};

std::optional<GridNode> PredictNode(const ArrayCalibration& array, const StereoPair& pair,
                                    const Cylinder& pipe, const Eigen::Vector2i& center) {
  constexpr double kStep_px = 4;
  const auto at = [&](double dx, double dy) {
    return TransferPixel(array, pair, pipe, center.cast<double>() + Eigen::Vector2d(dx, dy));
  };
  const auto middle = at(0, 0), right = at(kStep_px, 0), left = at(-kStep_px, 0);
  const auto below = at(0, kStep_px), above = at(0, -kStep_px);
  if (!middle || !right || !left || !below || !above) return {};
  GridNode node;
  node.center_px = center;
  node.second_px = *middle;
  node.second_from_first.col(0) = (*right - *left) / (2 * kStep_px);
  node.second_from_first.col(1) = (*below - *above) / (2 * kStep_px);
  return node;
}

bool Inside(const PixelRegion& region, const Eigen::Vector2d& pixel, double margin) {
  return pixel.x() >= region.x + margin && pixel.y() >= region.y + margin &&
         pixel.x() <= region.x + region.width - 1 - margin &&
         pixel.y() <= region.y + region.height - 1 - margin;
}

std::vector<GridNode> CommonNodes(const ArrayCalibration& array, const StereoPair& pair,
                                  const Cylinder& pipe, const PixelRegion& first,
                                  const PixelRegion& second, int subset_px) {
  const int margin = subset_px / 2 + kBorder_px;
  const int columns = (first.width - 2 * margin - 1) / subset_px + 1;
  const int rows = (first.height - 2 * margin - 1) / subset_px + 1;
  std::vector<GridNode> nodes;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const Eigen::Vector2i center(first.x + margin + column * subset_px,
                                   first.y + margin + row * subset_px);
      auto node = PredictNode(array, pair, pipe, center);
      if (!node || !Inside(second, node->second_px, margin)) continue;
      node->column = column;
      node->row = row;
      nodes.push_back(*node);
    }
  return nodes;
}

// How far the mean of the curved transfer over a subset lies from its value at the centre: an
// affine shape function finds the mean. Zero where the subset leaves the visible part of the pipe.
std::optional<Eigen::Vector2d> CurvatureShift_px(const ArrayCalibration& array,
                                                 const StereoPair& pair, const Cylinder& pipe,
                                                 const GridNode& node, int subset_px) {
  constexpr int kCells = 9;  // midpoint rule; leaves 1/81 of the shift
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      const Eigen::Vector2d offset(((i + 0.5) / kCells - 0.5) * subset_px,
                                   ((j + 0.5) / kCells - 0.5) * subset_px);
      const auto at = TransferPixel(array, pair, pipe, node.center_px.cast<double>() + offset);
      if (!at) return {};
      sum += *at - node.second_px;
    }
  return Eigen::Vector2d(sum / (kCells * kCells));
}

// A region of an image turned or mirrored onto a grid of its own that starts at (0, 0).
struct OrientedRegion {
  GrayImage image;
  Eigen::Matrix2d turn;            // signed permutation
  Eigen::Vector2d from_middle_px;  // of the region on the sensor
  Eigen::Vector2d to_middle_px;    // of the oriented image

  Eigen::Vector2d ToOriented(const Eigen::Vector2d& pixel) const {
    return turn * (pixel - from_middle_px) + to_middle_px;
  }
  Eigen::Vector2d ToSensor(const Eigen::Vector2d& pixel) const {
    return turn.transpose() * (pixel - to_middle_px) + from_middle_px;
  }
  PixelRegion Region() const { return {0, 0, image.width, image.height}; }
};

// The signed permutation that brings `map` nearest to the identity.
Eigen::Matrix2d NearestSymmetry(const Eigen::Matrix2d& map) {
  Eigen::Matrix2d best = Eigen::Matrix2d::Identity();
  double best_trace = -1e9;
  for (const bool swap : {false, true})
    for (const double x : {1.0, -1.0})
      for (const double y : {1.0, -1.0}) {
        Eigen::Matrix2d turn = Eigen::Matrix2d::Zero();
        turn(0, swap ? 1 : 0) = x;
        turn(1, swap ? 0 : 1) = y;
        const double trace = (turn * map).trace();
        if (trace <= best_trace) continue;
        best_trace = trace;
        best = turn;
      }
  return best;
}

OrientedRegion Orient(const GrayImage& image, const PixelRegion& region,
                      const Eigen::Matrix2d& turn) {
  OrientedRegion oriented;
  oriented.turn = turn;
  const bool swap = turn(0, 0) == 0;
  oriented.image.width = swap ? region.height : region.width;
  oriented.image.height = swap ? region.width : region.height;
  oriented.image.max_gray = image.max_gray;
  oriented.from_middle_px = region.Middle();
  oriented.to_middle_px = oriented.Region().Middle();
  oriented.image.pixels.resize(static_cast<std::size_t>(region.width) *
                               static_cast<std::size_t>(region.height));
  const Eigen::Vector2i origin = oriented.ToSensor({0, 0}).array().round().cast<int>();
  const Eigen::Matrix2i step = turn.transpose().cast<int>();
  for (int y = 0; y < oriented.image.height; ++y)
    for (int x = 0; x < oriented.image.width; ++x) {
      const Eigen::Vector2i from = origin + step * Eigen::Vector2i(x, y);
      oriented.image.At(x, y) = image.At(from.x(), from.y());
    }
  return oriented;
}

Eigen::Matrix2d MeanMap(const std::vector<GridNode>& nodes) {
  Eigen::Matrix2d mean = Eigen::Matrix2d::Zero();
  for (const GridNode& node : nodes)
    mean += node.second_from_first / static_cast<double>(nodes.size());
  return mean;
}

bool OnEpipolarLine(const ArrayCalibration& array, const StereoPair& pair,
                    const StereoMatch& match) {
  const TriangulatedPoint surface = Triangulate(
      array, {{pair.first, match.first_center_px.cast<double>(), Eigen::Matrix2d::Zero()},
              {pair.second, match.second_pixel, match.covariance_px2}});
  return surface.residual_px <= kMaxEpipolar_px;
}

}  // namespace

StereoMatches MatchAcross(const ArrayCalibration& array, const StereoPair& pair,
                          const Cylinder& pipe, const GrayImage& image,
                          const CorrelationReference& first, const PixelRegion& second) {
  const std::vector<GridNode> nodes =
      CommonNodes(array, pair, pipe, first.region(), second, first.options().subset_px);
  StereoMatches matches;
  matches.nodes = static_cast<int>(nodes.size());
  if (nodes.empty()) return matches;
  const Eigen::Matrix2d mean = MeanMap(nodes);
  const OrientedRegion oriented = Orient(image, second, NearestSymmetry(mean));
  std::vector<Eigen::Vector2i> centers;
  std::vector<ShapeFunction> starts;
  for (const GridNode& node : nodes) {
    centers.push_back(node.center_px);
    starts.push_back({oriented.ToOriented(node.second_px) - node.center_px.cast<double>(),
                      oriented.turn * node.second_from_first - Eigen::Matrix2d::Identity()});
  }
  // The second view sees the pattern stretched; its blur is stretched alike.
  const PreparedImage prepared(oriented.image, oriented.Region(), first.options(),
                               oriented.turn * mean - Eigen::Matrix2d::Identity());
  const std::vector<SubsetMatch> found = CorrelatePoints(first, centers, prepared, starts);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!found[i].ok()) {
      ++matches.rejected["between the views: " + ToText(found[i].status)];
      continue;
    }
    const auto shift = CurvatureShift_px(array, pair, pipe, nodes[i], first.options().subset_px);
    if (!shift) {
      ++matches.rejected["between the views: at the edge of the visible surface"];
      continue;
    }
    StereoMatch match{
        nodes[i].column, nodes[i].row, nodes[i].center_px,
        oriented.ToSensor(nodes[i].center_px.cast<double>() + found[i].shape.displacement_px) -
            *shift,
        oriented.turn.transpose() * found[i].covariance.topLeftCorner<2, 2>() * oriented.turn};
    if (OnEpipolarLine(array, pair, match))
      matches.found.push_back(match);
    else
      ++matches.rejected["between the views: off the epipolar line"];
  }
  return matches;
}

}  // namespace telestrain
