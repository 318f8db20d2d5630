#include "target/board_ends.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace telestrain {
namespace {

using Eigen::Vector2d;

constexpr double kReach = 0.42;          // of a square, across the border
constexpr double kSideMargin = 0.2;      // of a square, kept free along the border
constexpr int kAcross = 29, kAlong = 8;  // samples
// For the border's place, of a square and in any case allowed px: at one place of it and on
// average. The grid predicts it to some hundredths of a pixel; a cover's edge that runs by chance
// along it is farther off.
constexpr double kEdgeTolerance = 0.02, kLeastEdgeTolerance_px = 0.4;
constexpr double kMeanTolerance = 0.005, kLeastMeanTolerance_px = 0.15;
constexpr double kLevelTolerance = 0.15;  // of bright - dark, against the nearest corners
constexpr double kStepTolerance = 0.1;    // of bright - dark, plate against square
constexpr double kClearOfEdge = 3;        // blurs
constexpr double kFarReach = 0.9;  // of a square beyond the border, where the view goes so far
constexpr int kFar = 12;           // samples
constexpr int kLeastOfAKind = 2, kLeastPlaces = 5;
constexpr double kLeastShare = 0.7;  // of the places of a kind
constexpr int kPassedPerContinuing = 5;

// One end line: squares between the line and the border; `outward` points away from the grid.
struct End {
  int axis = 0;
  int line = 0;
  int outward = 1;

  // Grid coordinates at `across` squares beyond the border and `along` on the other axis.
  std::pair<double, double> At(double across, double along) const {
    const double on_axis = line + outward * (1 + across);
    return axis == 0 ? std::pair{on_axis, along} : std::pair{along, on_axis};
  }
  LatticeIndex Corner(int along) const {
    return axis == 0 ? LatticeIndex{line, along} : LatticeIndex{along, line};
  }
  // Lower corner of the square between the line and the border.
  LatticeIndex Square(int along) const {
    const int low = outward > 0 ? line : line - 1;
    return axis == 0 ? LatticeIndex{low, along} : LatticeIndex{along, low};
  }
};

// Bright and dark level at the corners of the end line that a place adjoins.
struct Levels {
  double bright = 0, dark = 0;
  double Step() const { return bright - dark; }
};

std::optional<Levels> NearestLevels(const CornerGrid& grid, const End& end, int along) {
  Levels levels;
  int count = 0;
  for (const int at : {along, along + 1}) {
    const auto corner = grid.corners.find(end.Corner(at));
    if (corner == grid.corners.end()) continue;
    levels.bright += corner->second.level_gray + std::abs(corner->second.contrast_gray);
    levels.dark += corner->second.level_gray - std::abs(corner->second.contrast_gray);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return Levels{levels.bright / count, levels.dark / count};
}

using Profile = std::array<double, kAcross>;

// The whole place and its two halves along the border, which tell an edge that runs otherwise.
struct PlaceProfile {
  Profile whole{};
  std::array<Profile, 2> halves{};
  double far_low = 1e9, far_high = -1e9;  // of the levels behind the place, as far as they are seen
};

double Across(int sample) { return kReach * (2.0 * sample / (kAcross - 1) - 1); }

double Interpolate(const GrayImage& image, const Vector2d& p) {
  const int x = static_cast<int>(p.x()), y = static_cast<int>(p.y());
  const double fx = p.x() - x, fy = p.y() - y;
  const float* top = image.pixels.data() + static_cast<std::ptrdiff_t>(y) * image.width + x;
  const float* bottom = top + image.width;
  return (1 - fy) * ((1 - fx) * static_cast<double>(top[0]) + fx * static_cast<double>(top[1])) +
         fy * ((1 - fx) * static_cast<double>(bottom[0]) + fx * static_cast<double>(bottom[1]));
}

bool IsSampled(const PixelRegion& region, const Vector2d& p) {
  return p.x() >= region.x && p.y() >= region.y && p.x() < region.x + region.width - 1 &&
         p.y() < region.y + region.height - 1;
}

// What lies between the profile's end and the far reach: squares that go on under a cover show
// somewhere.
void SampleFar(const GrayImage& image, const PixelRegion& region, const CornerGrid& grid,
               std::pair<const End&, int> place, PlaceProfile* profile) {
  const auto& [end, along] = place;
  for (int a = 1; a <= kFar; ++a) {
    double sum = 0;
    int count = 0;
    for (int s = 0; s < kAlong; ++s) {
      const double share = kSideMargin + (1 - 2 * kSideMargin) * s / (kAlong - 1);
      const auto [i, j] = end.At(kReach + (kFarReach - kReach) * a / kFar, along + share);
      const Vector2d p = grid.At(i, j);
      if (IsSampled(region, p)) sum += Interpolate(image, p), ++count;
    }
    if (count < kAlong / 2) continue;
    profile->far_low = std::min(profile->far_low, sum / count);
    profile->far_high = std::max(profile->far_high, sum / count);
  }
}

// Grey levels across the border, averaged along it; nothing when they leave the view.
std::optional<PlaceProfile> SampleAcross(const GrayImage& image, const PixelRegion& region,
                                         const CornerGrid& grid, const End& end, int along) {
  PlaceProfile profile;
  for (std::size_t a = 0; a < kAcross; ++a) {
    for (int s = 0; s < kAlong; ++s) {
      const double share = kSideMargin + (1 - 2 * kSideMargin) * s / (kAlong - 1);
      const auto [i, j] = end.At(Across(static_cast<int>(a)), along + share);
      const Vector2d p = grid.At(i, j);
      if (!IsSampled(region, p)) return std::nullopt;
      profile.halves[s < kAlong / 2 ? 0 : 1][a] += Interpolate(image, p) / (kAlong / 2);
    }
    profile.whole[a] = 0.5 * (profile.halves[0][a] + profile.halves[1][a]);
  }
  SampleFar(image, region, grid, {end, along}, &profile);
  return profile;
}

// Mean over the samples with low <= across <= high.
double MeanOver(const Profile& profile, double low, double high) {
  double sum = 0;
  int count = 0;
  for (int a = 0; a < kAcross; ++a)
    if (Across(a) >= low && Across(a) <= high) sum += profile[static_cast<std::size_t>(a)], ++count;
  return count > 0 ? sum / count : 0;
}

// Where a profile passes midway between its ends' levels; nothing when more or less than once.
std::optional<double> Crossing(const Profile& profile, double inside, double outside) {
  const double middle = 0.5 * (inside + outside);
  std::optional<double> at;
  for (int a = 0; a + 1 < kAcross; ++a) {
    const double p = profile[static_cast<std::size_t>(a)] - middle;
    const double q = profile[static_cast<std::size_t>(a + 1)] - middle;
    if ((p > 0) == (q > 0)) continue;
    if (at) return std::nullopt;
    at = Across(a) + (Across(a + 1) - Across(a)) * p / (p - q);
  }
  return at;
}

enum class Place { kFails, kEndsHere, kPassesInto, kContinues };

struct Judgement {
  Place place = Place::kFails;
  double edge = 0;  // of a square that ends here, in squares beyond the predicted border
};

double LargestDeparture(const Profile& profile, double level) {
  double largest = 0;
  for (const double gray : profile) largest = std::max(largest, std::abs(gray - level));
  return largest;
}

struct PlateTone {
  bool is_bright = false;
};

// Squares between edges, and the part of one about an edge that its blur takes.
struct Scale {
  double square_px = 0;
  double clear = 0;

  double Tolerance(double share, double least_px) const {
    return std::max(share, least_px / square_px);
  }
};

struct Sample {
  PlaceProfile profile;
  Levels levels;
  bool square_is_bright = false;
};

Judgement Judge(const Sample& sample, PlateTone plate, const Scale& scale) {
  const Profile& profile = sample.profile.whole;
  const Levels& levels = sample.levels;
  const double inside = MeanOver(profile, -kReach, -scale.clear);
  const double outside = MeanOver(profile, scale.clear, kReach);
  const double own = sample.square_is_bright ? levels.bright : levels.dark;
  const double other = sample.square_is_bright ? levels.dark : levels.bright;
  const double tolerance = kLevelTolerance * levels.Step();
  const bool is_plain_behind =
      sample.profile.far_high < outside + tolerance && sample.profile.far_low > outside - tolerance;
  if (std::abs(inside - own) > tolerance) return {};
  if (sample.square_is_bright == plate.is_bright) {
    if (std::abs(outside - other) < tolerance) return {Place::kContinues, 0};
    const bool no_step = is_plain_behind &&
                         std::abs(outside - inside) < kStepTolerance * levels.Step() &&
                         LargestDeparture(profile, own) < 2 * tolerance;
    return {no_step ? Place::kPassesInto : Place::kFails, 0};
  }
  if (std::abs(outside - other) > tolerance || !is_plain_behind) return {};
  double sum = 0;
  for (const Profile& half : sample.profile.halves) {
    const auto edge = Crossing(half, inside, outside);
    if (!edge || std::abs(*edge) > scale.Tolerance(kEdgeTolerance, kLeastEdgeTolerance_px))
      return {};
    sum += *edge;
  }
  return {Place::kEndsHere, 0.5 * sum};
}

// Places by kind: `other` are those whose square has not the plate's tone.
struct Tally {
  int others = 0, ends_here = 0;
  int likes = 0, passes_into = 0, continues = 0;

  double edges = 0;

  void Add(bool like, const Judgement& judgement) {
    ++(like ? likes : others);
    ends_here += judgement.place == Place::kEndsHere;
    passes_into += judgement.place == Place::kPassesInto;
    continues += judgement.place == Place::kContinues;
    edges += judgement.edge;
  }
  BeyondEnd Verdict(const Scale& scale) const {
    const bool ends =
        ends_here >= kLeastOfAKind && ends_here >= kLeastShare * others &&
        std::abs(edges) <= ends_here * scale.Tolerance(kMeanTolerance, kLeastMeanTolerance_px);
    // Squares of the other tone end in either case.
    if (ends && continues >= kLeastOfAKind && passes_into == 0) return BeyondEnd::kContinues;
    if (ends && passes_into >= kLeastOfAKind && ends_here + passes_into >= kLeastPlaces &&
        passes_into >= kLeastShare * likes && passes_into >= kPassedPerContinuing * continues)
      return BeyondEnd::kBorder;
    return BeyondEnd::kUnknown;
  }
};

std::vector<Sample> SamplesOf(const GrayImage& image, const PixelRegion& region,
                              const CornerGrid& grid, const End& end) {
  std::vector<Sample> samples;
  const int first = end.axis == 0 ? grid.first.second : grid.first.first;
  const int last = end.axis == 0 ? grid.last.second : grid.last.first;
  for (int along = first - 1; along <= last; ++along) {
    const auto levels = NearestLevels(grid, end, along);
    if (!levels) continue;
    const auto profile = SampleAcross(image, region, grid, end, along);
    const LatticeIndex square = end.Square(along);
    if (profile) samples.push_back({*profile, *levels, grid.IsBright(square.first, square.second)});
  }
  return samples;
}

Scale ScaleAcross(const CornerGrid& grid, int axis) {
  const Eigen::Matrix2d axes = grid.Axes_px();
  const double square_px = std::abs(axes.determinant()) / axes.col(1 - axis).norm();
  return {square_px, std::min(0.3, kClearOfEdge * grid.blur_px / square_px + 0.03)};
}

using Tallies = std::array<std::array<Tally, 2>, 2>;  // [axis][last]

int PassesInto(const Tallies& tallies) {
  int sum = 0;
  for (const auto& axis : tallies)
    for (const Tally& tally : axis) sum += tally.passes_into;
  return sum;
}

}  // namespace

BoardEnds FindBoardEnds(const GrayImage& image, const PixelRegion& region, const CornerGrid& grid) {
  std::array<Tallies, 2> tones;  // by whether the plate is bright
  const std::array<Scale, 2> scales{ScaleAcross(grid, 0), ScaleAcross(grid, 1)};
  for (const std::size_t axis : {0, 1})
    for (const std::size_t last : {0, 1}) {
      const LatticeIndex& at = last ? grid.last : grid.first;
      const End end{static_cast<int>(axis), axis == 0 ? at.first : at.second, last ? 1 : -1};
      for (const Sample& sample : SamplesOf(image, region, grid, end))
        for (const bool bright : {false, true})
          tones[bright][axis][last].Add(sample.square_is_bright == bright,
                                        Judge(sample, PlateTone{bright}, scales[axis]));
    }
  const Tallies& tone = tones[PassesInto(tones[1]) >= PassesInto(tones[0]) ? 1 : 0];
  BoardEnds ends;
  for (const std::size_t axis : {0, 1})
    for (const std::size_t last : {0, 1}) ends[axis][last] = tone[axis][last].Verdict(scales[axis]);
  return ends;
}

}  // namespace telestrain
