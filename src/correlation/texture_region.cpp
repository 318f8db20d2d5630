#include "correlation/texture_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "correlation/noise_estimate.h"

namespace telestrain {

using namespace correlation;

namespace {

constexpr int kBins = 64;
constexpr double kClassesApart = 10;     // energies of texture and background
constexpr double kAboveNoise = 3;        // energy against that of noise
constexpr double kLeastEnergy = 1;       // rms gradient of one grey level a pixel of 255
constexpr double kShareOfTexture = 0.5;  // the level that bounds the region
constexpr double kClip = 6;             // of the typical energy: edges of the region are no texture
constexpr double kMostSaturated = 0.5;  // of a window

// One value per cell of `cell_px`, row by row.
struct CellGrid {
  int columns = 0, rows = 0, cell_px = 1;
  template <class Value>
  std::vector<Value> Make(Value value) const {
    return std::vector<Value>(static_cast<std::size_t>(columns) * rows, value);
  }
  int At(int column, int row) const { return row * columns + column; }
};

struct CellSums {
  std::vector<double> xx, yy, saturated;
};

// Sums of squared central differences, each at most `clip`, as means per pixel.
CellSums SumCells(const GrayImage& image, const CellGrid& grid, double clip) {
  CellSums sums{grid.Make(0.0), grid.Make(0.0), grid.Make(0.0)};
  const double weight = 1.0 / (grid.cell_px * grid.cell_px);
  for (int y = 1; y < std::min(image.height - 1, grid.rows * grid.cell_px); ++y) {
    for (int x = 1; x < std::min(image.width - 1, grid.columns * grid.cell_px); ++x) {
      const double gx = 0.5 * (image.At(x + 1, y) - image.At(x - 1, y));
      const double gy = 0.5 * (image.At(x, y + 1) - image.At(x, y - 1));
      const int cell = grid.At(x / grid.cell_px, y / grid.cell_px);
      sums.xx[cell] += weight * std::min(gx * gx, clip);
      sums.yy[cell] += weight * std::min(gy * gy, clip);
      sums.saturated[cell] += image.At(x, y) >= image.max_gray ? weight : 0;
    }
  }
  return sums;
}

// Mean over the windows of (2 reach + 1)^2 cells.
std::vector<double> WindowMeans(const CellGrid& grid, const std::vector<double>& cells, int reach) {
  std::vector<double> means = grid.Make(0.0);
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      double sum = 0, count = 0;
      for (int r = std::max(0, row - reach); r <= std::min(grid.rows - 1, row + reach); ++r)
        for (int c = std::max(0, column - reach); c <= std::min(grid.columns - 1, column + reach);
             ++c, ++count)
          sum += cells[grid.At(c, r)];
      means[grid.At(column, row)] = sum / count;
    }
  }
  return means;
}

// Energy of the weaker direction in every window; zero where most of it is saturated.
std::vector<double> Energies(const CellGrid& grid, const CellSums& sums, int reach) {
  const auto xx = WindowMeans(grid, sums.xx, reach), yy = WindowMeans(grid, sums.yy, reach);
  const auto saturated = WindowMeans(grid, sums.saturated, reach);
  std::vector<double> energies = xx;
  for (std::size_t k = 0; k < xx.size(); ++k)
    energies[k] = saturated[k] > kMostSaturated ? 0 : std::min(xx[k], yy[k]);
  return energies;
}

// Otsu's threshold of the energies on a logarithmic scale; `least` when they are one class.
double Threshold(const std::vector<double>& energies, double least) {
  const double low = std::log(least) - 3;
  const double high =
      std::log(std::max(*std::max_element(energies.begin(), energies.end()), 2 * least));
  std::array<double, kBins> counts{};
  const auto level = [&](double energy) {
    return std::clamp((std::log(std::max(energy, 1e-300)) - low) / (high - low), 0.0, 1.0);
  };
  double all = 0, sum = 0;
  for (double energy : energies) {
    const int bin = std::min(kBins - 1, static_cast<int>(level(energy) * kBins));
    counts[bin] += 1;
    all += 1;
    sum += bin;
  }
  double best = 0, below = 0, sum_below = 0, cut = 0, apart = 0;
  for (int bin = 0; bin + 1 < kBins; ++bin) {
    below += counts[bin];
    sum_below += bin * counts[bin];
    if (below == 0 || below == all) continue;
    const double gap = (sum - sum_below) / (all - below) - sum_below / below;
    const double between = below * (all - below) * gap * gap;
    if (!(between > best)) continue;
    best = between;
    cut = bin + 1;
    apart = gap;
  }
  const double scale = (high - low) / kBins;
  if (!(apart * scale > std::log(kClassesApart))) return least;
  return std::max(least, std::exp(low + cut * scale));
}

double MedianAbove(std::vector<double> energies, double threshold) {
  std::erase_if(energies, [&](double energy) { return !(energy >= threshold); });
  if (energies.empty()) return 0;
  const auto middle = energies.begin() + static_cast<std::ptrdiff_t>(energies.size() / 2);
  std::nth_element(energies.begin(), middle, energies.end());
  return *middle;
}

// Cells of `value` connected with `start` over their sides; they are set to `mark`.
std::vector<int> TakeConnected(const CellGrid& grid, int start, char value, char mark,
                               std::vector<char>& cells) {
  std::vector<int> connected = {start};
  cells[start] = mark;
  for (std::size_t k = 0; k < connected.size(); ++k) {
    const int column = connected[k] % grid.columns, row = connected[k] / grid.columns;
    const std::array<std::array<int, 2>, 4> sides = {
        {{column - 1, row}, {column + 1, row}, {column, row - 1}, {column, row + 1}}};
    for (const auto& [c, r] : sides) {
      if (c < 0 || r < 0 || c >= grid.columns || r >= grid.rows) continue;
      if (cells[grid.At(c, r)] != value) continue;
      cells[grid.At(c, r)] = mark;
      connected.push_back(grid.At(c, r));
    }
  }
  return connected;
}

// Only the largest connected part stays, its holes of less than `hole` cells filled.
void KeepLargest(const CellGrid& grid, std::size_t hole, std::vector<char>& cells) {
  std::vector<int> largest;
  for (int k = 0; k < static_cast<int>(cells.size()); ++k) {
    if (cells[k] != 1) continue;
    auto part = TakeConnected(grid, k, 1, 2, cells);
    if (part.size() > largest.size()) largest = std::move(part);
  }
  std::fill(cells.begin(), cells.end(), 0);
  for (int k : largest) cells[k] = 1;
  for (int k = 0; k < static_cast<int>(cells.size()); ++k) {
    if (cells[k] != 0) continue;
    const auto part = TakeConnected(grid, k, 0, 3, cells);
    if (part.size() < hole)
      for (int cell : part) cells[cell] = 1;
  }
  for (char& cell : cells) cell = cell == 1;
}

PixelMask ToMask(const GrayImage& image, const CellGrid& grid, const std::vector<char>& cells) {
  PixelMask mask{image.width, image.height, {}};
  mask.inside.reserve(image.pixels.size());
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const int column = std::min(x / grid.cell_px, grid.columns - 1);
      const int row = std::min(y / grid.cell_px, grid.rows - 1);
      mask.inside.push_back(static_cast<unsigned char>(cells[grid.At(column, row)]));
    }
  return mask;
}

}  // namespace

PixelMask TextureRegion(const GrayImage& image, int subset_px) {
  const int cell = std::max(2, subset_px / 8);
  const CellGrid grid{image.width / cell, image.height / cell, cell};
  std::vector<char> cells = grid.Make<char>(0);
  if (cells.empty())
    return {image.width, image.height, std::vector<unsigned char>(image.pixels.size(), 0)};
  const int reach = std::max(1, subset_px / (4 * cell));
  const double noise = EstimateNoise_gray(image, {0, 0, image.width, image.height});
  const double scale = image.max_gray / 255;
  // A central difference holds half the variance of the noise.
  const double least = std::max(kAboveNoise * noise * noise / 2, kLeastEnergy * scale * scale);
  const auto rough = Energies(grid, SumCells(image, grid, 1e300), reach);
  const double typical = MedianAbove(rough, Threshold(rough, least));
  if (typical > 0) {
    const auto energies = Energies(grid, SumCells(image, grid, kClip * typical), reach);
    const double level = MedianAbove(energies, Threshold(energies, least));
    const double bound = std::max(least, kShareOfTexture * level);
    for (std::size_t k = 0; k < cells.size(); ++k) cells[k] = energies[k] >= bound;
  }
  const std::size_t across = static_cast<std::size_t>(std::max(1, subset_px / cell));
  KeepLargest(grid, across * across, cells);
  return ToMask(image, grid, cells);
}

}  // namespace telestrain
