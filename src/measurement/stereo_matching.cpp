#include "measurement/stereo_matching.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/parallel.h"
#include "measurement/triangulation.h"

namespace telestrain {
namespace {

constexpr int kBorder_px = 8;  // beyond the subset: room for the interpolation
constexpr double kInterpolationMargin_px = 3;
constexpr double kMaxEpipolar_px = 1.5;  // of a match; larger is a wrong match
// Where a node that does not match is looked for along its epipolar line: the correlation itself
// reaches 3 px to either side.
constexpr std::array<double, 6> kSearch_px{-5, 5, -10, 10, -15, 15};

// A node of the grid that both views can show.
struct GridNode {
  int column = 0, row = 0;
  Eigen::Vector2i center_px;
  // Unit; how the node moves in the first view when what it shows moves along the epipolar line
  // of the second one.
  Eigen::Vector2d line;
};

bool Inside(const PixelRegion& region, const Eigen::Vector2d& pixel, double margin) {
  return pixel.x() >= region.x + margin && pixel.y() >= region.y + margin &&
         pixel.x() <= region.x + region.width - 1 - margin &&
         pixel.y() <= region.y + region.height - 1 - margin;
}

// The transfer from the first to the second view through a pipe.
class Transfer {
 public:
  Transfer(const ArrayCalibration& array, const StereoPair& pair, const Cylinder& pipe)
      : array_(array), pair_(pair), pipe_(pipe) {}

  std::optional<Eigen::Vector2d> Of(const Eigen::Vector2d& pixel) const {
    return TransferPixel(array_, pair_, pipe_, pixel);
  }

  // Nothing where a point 4 px away is not visible.
  std::optional<Eigen::Matrix2d> LinearAt(const Eigen::Vector2d& pixel) const {
    constexpr double kStep_px = 4;
    const Eigen::Vector2d x(kStep_px, 0), y(0, kStep_px);
    const auto right = Of(pixel + x), left = Of(pixel - x), below = Of(pixel + y),
               above = Of(pixel - y);
    if (!right || !left || !below || !above) return {};
    Eigen::Matrix2d linear;
    linear << (*right - *left) / (2 * kStep_px), (*below - *above) / (2 * kStep_px);
    return linear;
  }

  // Direction in the second view in which the image of a point moves that moves along its ray of
  // the first view.
  Eigen::Vector2d EpipolarDirection(const Eigen::Vector2d& pixel) const {
    constexpr double kStep_mm = 0.1;
    const ImageRay ray = array_.RayOf(pair_.first, pixel);
    const auto hit = pipe_.Enter(ray.point_in_array_mm, ray.direction_in_array);
    const Eigen::Vector3d on_surface = hit.value_or(ray.point_in_array_mm);
    const Eigen::Vector3d step = kStep_mm * ray.direction_in_array;
    return array_.Project(pair_.second, on_surface + step) -
           array_.Project(pair_.second, on_surface - step);
  }

 private:
  const ArrayCalibration& array_;
  const StereoPair& pair_;
  const Cylinder& pipe_;
};

// The node at a centre, if the whole subset around it is on the visible surface and in both views.
std::optional<GridNode> NodeAt(const Transfer& transfer, const StereoImages& views,
                               const Eigen::Vector2i& center_px) {
  const double half_px = views.first.options().subset_px / 2;
  const Eigen::Vector2d pixel = center_px.cast<double>();
  for (const double y : {-half_px, 0.0, half_px})
    for (const double x : {-half_px, 0.0, half_px}) {
      const auto second = transfer.Of(pixel + Eigen::Vector2d(x, y));
      if (!second || !Inside(views.second, *second, kBorder_px)) return {};
    }
  const auto linear = transfer.LinearAt(pixel);
  if (!linear || std::abs(linear->determinant()) < 1e-3) return {};
  GridNode node;
  node.center_px = center_px;
  node.line = (linear->inverse() * transfer.EpipolarDirection(pixel)).normalized();
  return node;
}

std::vector<GridNode> CommonNodes(const Transfer& transfer, const StereoImages& views,
                                  int step_px) {
  const PixelRegion& first = views.first.region();
  const int margin = views.first.options().subset_px / 2 + kBorder_px;
  const int columns = (first.width - 2 * margin - 1) / step_px + 1;
  const int rows = (first.height - 2 * margin - 1) / step_px + 1;
  std::vector<GridNode> nodes;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      auto node = NodeAt(transfer, views,
                         {first.x + margin + column * step_px, first.y + margin + row * step_px});
      if (!node) continue;
      node->column = column;
      node->row = row;
      nodes.push_back(*node);
    }
  return nodes;
}

// The second view as the first one would see it: every pixel of the first region shows what the
// transfer says. Pixels without an image get the mean grey level.
GrayImage SeenByFirst(const Transfer& transfer, const StereoImages& views) {
  const PixelRegion& region = views.first.region();
  CorrelationOptions sharp = views.first.options();
  sharp.prefilter_sigma_px = 0;
  const PreparedImage second(views.image, views.second, sharp);
  GrayImage seen{region.width, region.height, views.image.max_gray, {}};
  seen.pixels.assign(static_cast<std::size_t>(region.width) * region.height, 0.f);
  std::vector<unsigned char> known(seen.pixels.size(), 0);
  ParallelFor(region.height, sharp.threads, [&](int y) {
    for (int x = 0; x < region.width; ++x) {
      const auto pixel = transfer.Of(Eigen::Vector2d(region.x + x, region.y + y));
      if (!pixel || !Inside(views.second, *pixel, kInterpolationMargin_px)) continue;
      seen.At(x, y) = second.Sample(pixel->x(), pixel->y());
      known[static_cast<std::size_t>(y) * region.width + x] = 1;
    }
  });
  const auto count = std::max<std::ptrdiff_t>(1, std::count(known.begin(), known.end(), 1));
  const double sum = std::accumulate(seen.pixels.begin(), seen.pixels.end(), 0.0);
  for (std::size_t i = 0; i < known.size(); ++i)
    if (!known[i]) seen.pixels[i] = static_cast<float>(sum / static_cast<double>(count));
  return seen;
}

// What is matched: the first view's grid in the second view as the first one would see it.
class PairMatcher {
 public:
  PairMatcher(const Transfer& transfer, const StereoImages& views)
      : first_(views.first),
        seen_origin_px_(views.first.region().x, views.first.region().y),
        seen_(SeenByFirst(transfer, views),
              {0, 0, views.first.region().width, views.first.region().height},
              views.first.options()) {}

  std::vector<SubsetMatch> Match(const std::vector<GridNode>& nodes) const {
    std::vector<Eigen::Vector2i> centers;
    for (const GridNode& node : nodes) centers.push_back(node.center_px);
    return CorrelatePoints(first_, centers, seen_, {StartAt({0, 0})});
  }

  // Looks for the nodes that do not match along their epipolar lines; how many were found.
  int Search(const std::vector<GridNode>& nodes, std::vector<SubsetMatch>& found) const {
    std::vector<std::size_t> failed;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (!found[i].ok() && found[i].status != MatchStatus::kLowContrast) failed.push_back(i);
    ParallelFor(static_cast<int>(failed.size()), first_.options().threads, [&](int k) {
      const std::size_t i = failed[static_cast<std::size_t>(k)];
      for (const double along_px : kSearch_px) {
        const SubsetMatch match =
            first_.Match(nodes[i].center_px, seen_, StartAt(along_px * nodes[i].line));
        if (!match.ok()) continue;
        found[i] = match;
        return;
      }
    });
    return static_cast<int>(
        std::count_if(failed.begin(), failed.end(), [&](std::size_t i) { return found[i].ok(); }));
  }

  // Where in the first view the transfer starts that ends at the match.
  Eigen::Vector2d Matched_px(const GridNode& node, const SubsetMatch& match) const {
    return node.center_px.cast<double>() + match.shape.displacement_px + seen_origin_px_;
  }

 private:
  ShapeFunction StartAt(const Eigen::Vector2d& displacement_px) const {
    ShapeFunction start;
    start.displacement_px = displacement_px - seen_origin_px_;
    return start;
  }

  const CorrelationReference& first_;
  Eigen::Vector2d seen_origin_px_;  // the image as seen begins at (0, 0)
  PreparedImage seen_;
};

bool OnEpipolarLine(const ArrayCalibration& array, const StereoPair& pair,
                    const StereoMatch& match) {
  const TriangulatedPoint surface = Triangulate(
      array, {{pair.first, match.first_center_px.cast<double>(), Eigen::Matrix2d::Zero()},
              {pair.second, match.second_pixel, match.covariance_px2}});
  return surface.residual_px <= kMaxEpipolar_px;
}

}  // namespace

StereoMatches MatchAcross(const ArrayCalibration& array, const StereoPair& pair,
                          const Cylinder& pipe, const StereoImages& views, int step_px) {
  const Transfer transfer(array, pair, pipe);
  const std::vector<GridNode> nodes = CommonNodes(transfer, views, step_px);
  StereoMatches matches;
  matches.nodes = static_cast<int>(nodes.size());
  if (nodes.empty()) return matches;
  const PairMatcher matcher(transfer, views);
  std::vector<SubsetMatch> found = matcher.Match(nodes);
  matches.found_by_search = matcher.Search(nodes, found);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!found[i].ok()) {
      ++matches.rejected["between the views: " + ToText(found[i].status)];
      continue;
    }
    const Eigen::Vector2d matched = matcher.Matched_px(nodes[i], found[i]);
    const auto second = transfer.Of(matched);
    const auto linear = transfer.LinearAt(matched);
    if (!second || !linear) {
      ++matches.rejected["between the views: at the edge of the visible surface"];
      continue;
    }
    const StereoMatch match{
        nodes[i].column, nodes[i].row, nodes[i].center_px, *second,
        *linear * found[i].covariance.topLeftCorner<2, 2>() * linear->transpose()};
    if (OnEpipolarLine(array, pair, match))
      matches.found.push_back(match);
    else
      ++matches.rejected["between the views: off the epipolar line"];
  }
  return matches;
}

}  // namespace telestrain
