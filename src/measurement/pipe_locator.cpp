#include "measurement/pipe_locator.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/numbers.h"
#include "base/parallel.h"
#include "geometry/rotation.h"

namespace telestrain {
namespace {

constexpr double kMinFacing = 0.3;     // cosine between the surface normal and a view
constexpr double kMinAgreement = 0.3;  // correlation below which the two views do not match
constexpr int kCoarseWidth_px = 162;   // width of a region on the coarsest level

// A region reduced by `factor`, every pixel normalised by the mean and deviation around it, so that
// shading and gain drop out.
struct ReducedRegion {
  PixelRegion region;
  int factor = 1;
  int width = 0, height = 0;
  std::vector<float> values;

  // Bilinear value at a pixel of the whole sensor; nothing outside.
  std::optional<float> Sample(const Eigen::Vector2d& pixel) const {
    const double x = (pixel.x() - region.x + 0.5) / factor - 0.5;
    const double y = (pixel.y() - region.y + 0.5) / factor - 0.5;
    if (!(x >= 0 && y >= 0 && x < width - 1 && y < height - 1)) return {};
    const int ix = static_cast<int>(x), iy = static_cast<int>(y);
    const float fx = static_cast<float>(x - ix), fy = static_cast<float>(y - iy);
    const float* row = values.data() + static_cast<std::size_t>(iy) * width + ix;
    return (row[0] * (1 - fx) + row[1] * fx) * (1 - fy) +
           (row[width] * (1 - fx) + row[width + 1] * fx) * fy;
  }
};

std::vector<float> BoxReduce(const GrayImage& image, const PixelRegion& region, int factor,
                             int width, int height) {
  std::vector<float> reduced(static_cast<std::size_t>(width) * height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      float sum = 0;
      for (int j = 0; j < factor; ++j)
        for (int i = 0; i < factor; ++i)
          sum += image.At(region.x + x * factor + i, region.y + y * factor + j);
      reduced[static_cast<std::size_t>(y) * width + x] = sum / static_cast<float>(factor * factor);
    }
  return reduced;
}

ReducedRegion Reduce(const GrayImage& image, const PixelRegion& region, int factor) {
  constexpr int kRadius = 5;
  ReducedRegion out{region, factor, region.width / factor, region.height / factor, {}};
  const std::vector<float> gray = BoxReduce(image, region, factor, out.width, out.height);
  // Summed-area tables of the values and their squares.
  const std::size_t stride = static_cast<std::size_t>(out.width) + 1;
  std::vector<double> sums(stride * (out.height + 1), 0.0), squares(sums);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const double v = gray[static_cast<std::size_t>(y) * out.width + x];
      const std::size_t at = (y + 1) * stride + x + 1;
      sums[at] = v + sums[at - 1] + sums[at - stride] - sums[at - stride - 1];
      squares[at] = v * v + squares[at - 1] + squares[at - stride] - squares[at - stride - 1];
    }
  out.values.resize(gray.size());
  const auto box = [&](const std::vector<double>& table, int x0, int y0, int x1, int y1) {
    return table[y1 * stride + x1] - table[y0 * stride + x1] - table[y1 * stride + x0] +
           table[y0 * stride + x0];
  };
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const int x0 = std::max(0, x - kRadius), x1 = std::min(out.width, x + kRadius + 1);
      const int y0 = std::max(0, y - kRadius), y1 = std::min(out.height, y + kRadius + 1);
      const double count = static_cast<double>(x1 - x0) * (y1 - y0);
      const double mean = box(sums, x0, y0, x1, y1) / count;
      const double variance = box(squares, x0, y0, x1, y1) / count - mean * mean;
      const std::size_t at = static_cast<std::size_t>(y) * out.width + x;
      out.values[at] = static_cast<float>((gray[at] - mean) / std::sqrt(std::max(4.0, variance)));
    }
  return out;
}

// The search parameters: shift across and along the viewing direction, yaw and pitch of the axis.
using PipeParameters = std::array<double, 4>;

struct SearchFrame {
  Eigen::Vector3d surface_point;  // of the nominal patch
  Eigen::Vector3d along, across, depth;
  double radius_mm;

  Cylinder Pipe(const PipeParameters& p) const {
    Cylinder pipe;
    pipe.radius_mm = radius_mm;
    pipe.axis_point_mm = surface_point + across * p[0] + depth * (radius_mm + p[1]);
    pipe.axis = (along + across * p[2] + depth * p[3]).normalized();
    return pipe;
  }
};

SearchFrame MakeFrame(const Session& session, const StereoPair& pair) {
  SearchFrame frame;
  frame.surface_point = session.views[static_cast<std::size_t>(pair.first)].center_in_array_mm;
  frame.along = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d mean = pair.first_axis + pair.second_axis;
  frame.depth = (mean - frame.along * frame.along.dot(mean)).normalized();
  frame.across = frame.depth.cross(frame.along);
  frame.radius_mm = session.pipe.outer_diameter_mm / 2;
  return frame;
}

// Compares the two views through a hypothetical pipe.
class Agreement {
 public:
  Agreement(const ArrayCalibration& array, const StereoPair& pair, const GrayImage& image,
            const PixelRegion& first, const PixelRegion& second, int factor)
      : array_(array), pair_(pair), second_(Reduce(image, second, factor)) {
    const ReducedRegion reduced = Reduce(image, first, factor);
    const int stride = std::max(1, reduced.width / 54);
    for (int y = stride; y < reduced.height - stride; y += stride)
      for (int x = stride; x < reduced.width - stride; x += stride) {
        pixels_.emplace_back(first.x + (x + 0.5) * factor - 0.5,
                             first.y + (y + 0.5) * factor - 0.5);
        values_.push_back(reduced.values[static_cast<std::size_t>(y) * reduced.width + x]);
      }
    for (const Eigen::Vector2d& pixel : pixels_) rays_.push_back(array.RayOf(pair.first, pixel));
  }

  // From every `stride`-th ray.
  double Score(const Cylinder& pipe, std::size_t stride = 1) const {
    double fg = 0, ff = 0, gg = 0;
    std::size_t valid = 0;
    for (std::size_t i = 0; i < rays_.size(); i += stride) {
      const auto hit = pipe.Enter(rays_[i].point_in_array_mm, rays_[i].direction_in_array);
      if (!hit || pipe.Normal(*hit).dot(pair_.second_axis) > -kMinFacing) continue;
      const auto value = second_.Sample(array_.Project(pair_.second, *hit));
      if (!value) continue;
      fg += values_[i] * *value;
      ff += values_[i] * values_[i];
      gg += *value * *value;
      valid += stride;
    }
    if (5 * valid < rays_.size()) return -1;  // too little of the patch is common
    return fg / std::sqrt(std::max(1e-9, ff * gg));
  }

 private:
  const ArrayCalibration& array_;
  const StereoPair& pair_;
  ReducedRegion second_;
  std::vector<Eigen::Vector2d> pixels_;
  std::vector<ImageRay> rays_;  // of the pixels
  std::vector<float> values_;
};

struct Trial {
  double score = -2;
  PipeParameters p{};
  bool operator<(const Trial& other) const { return score < other.score; }
};

// Every position with a part of the rays, then with all of them the best position of every row:
// chance agreement of the few is less than their share would suggest, but more than of the many.
PipeParameters SearchExhaustively(const Agreement& agreement, const SearchFrame& frame,
                                  double step_mm) {
  constexpr double kAcross_mm = 1.5, kDeeper_mm = 3.0;
  constexpr std::size_t kStride = 7;               // odd: not along the columns of the rays
  const double nearer_mm = frame.radius_mm + 1.5;  // the given centre may lie on the axis
  const int rows = static_cast<int>(2 * kAcross_mm / step_mm) + 1;
  const int columns = static_cast<int>((nearer_mm + kDeeper_mm) / step_mm) + 1;
  std::vector<Trial> best(static_cast<std::size_t>(rows));
  ParallelFor(rows, 0, [&](int row) {
    Trial& of_row = best[static_cast<std::size_t>(row)];
    for (int column = 0; column < columns; ++column) {
      const PipeParameters p{-kAcross_mm + row * step_mm, -nearer_mm + column * step_mm, 0, 0};
      of_row = std::max(of_row, {agreement.Score(frame.Pipe(p), kStride), p});
    }
    of_row.score = agreement.Score(frame.Pipe(of_row.p));
  });
  return std::max_element(best.begin(), best.end())->p;
}

// Pattern search: one parameter after the other, steps halved when nothing improves.
double Refine(const Agreement& agreement, const SearchFrame& frame, PipeParameters steps,
              double smallest_share, PipeParameters& p) {
  double best = agreement.Score(frame.Pipe(p));
  for (double share = 1; share >= smallest_share;) {
    bool improved = false;
    for (std::size_t i = 0; i < p.size(); ++i)
      for (const double sign : {-1.0, 1.0}) {
        PipeParameters trial = p;
        trial[i] += sign * share * steps[i];
        const double score = agreement.Score(frame.Pipe(trial));
        if (score <= best) continue;
        best = score;
        p = trial;
        improved = true;
      }
    if (!improved) share /= 2;
  }
  return best;
}

}  // namespace

Result<std::vector<StereoPair>> StereoPairs(const Session& session, const ArrayCalibration& array) {
  std::vector<StereoPair> pairs;
  for (const std::string& group : session.Groups()) {
    std::vector<int> members;
    for (std::size_t i = 0; i < session.views.size(); ++i)
      if (session.views[i].group == group) members.push_back(static_cast<int>(i));
    if (members.size() < 2)
      return BadInput("session.toml: group '" + group +
                      "' has one view; measuring the pipe needs two views that see the same patch");
    const auto axis_of = [&](int index) {
      return array.views[static_cast<std::size_t>(index)].ViewingDirection();
    };
    pairs.push_back({group, members[0], members[1], axis_of(members[0]), axis_of(members[1])});
  }
  if (pairs.size() < 2)
    return BadInput(
        "session.toml: the strain is measured between two groups of two views, found one group; "
        "add "
        "the second group or remove pipe.csv");
  return pairs;
}

std::optional<Eigen::Vector2d> TransferPixel(const ArrayCalibration& array, const StereoPair& pair,
                                             const Cylinder& pipe, const Eigen::Vector2d& pixel) {
  const ImageRay ray = array.RayOf(pair.first, pixel);
  const auto hit = pipe.Enter(ray.point_in_array_mm, ray.direction_in_array);
  if (!hit) return {};
  const Eigen::Vector3d normal = pipe.Normal(*hit);
  if (normal.dot(pair.first_axis) > -kMinFacing || normal.dot(pair.second_axis) > -kMinFacing)
    return {};
  return array.Project(pair.second, *hit);
}

Result<PipeLocation> LocatePipe(const Session& session, const ArrayCalibration& array,
                                const StereoPair& pair, const GrayImage& image) {
  const PixelRegion& first = session.views[static_cast<std::size_t>(pair.first)].region;
  const PixelRegion& second = session.views[static_cast<std::size_t>(pair.second)].region;
  const SearchFrame frame = MakeFrame(session, pair);
  const int coarsest = std::max(
      1, static_cast<int>(std::lround(static_cast<double>(first.width) / kCoarseWidth_px)));
  PipeParameters p{};
  PipeLocation location;
  for (int factor = coarsest, level = 0; level < 3; ++level, factor = std::max(1, factor / 2)) {
    const Agreement agreement(array, pair, image, first, second, factor);
    const double pixel_mm = factor / array.Magnification_px_per_mm();
    if (level == 0) p = SearchExhaustively(agreement, frame, pixel_mm);
    const double angle_rad = 2 * pixel_mm / (first.width / array.Magnification_px_per_mm());
    location.zncc = Refine(agreement, frame, {pixel_mm, pixel_mm, angle_rad, angle_rad}, 0.2, p);
  }
  location.pipe = frame.Pipe(p);
  if (location.zncc < kMinAgreement)
    return EstimationFailed(
        "group '" + pair.group + "': no position of a pipe of " +
        FormatShortest(session.pipe.outer_diameter_mm) +
        " mm makes its two views agree (best correlation " + FormatFixed(location.zncc, 2) +
        ", wanted " + FormatFixed(kMinAgreement, 2) +
        "); check [pipe] outer_diameter_mm, that the pipe is speckled and in both views");
  return location;
}

}  // namespace telestrain
