#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "base/console.h"
#include "base/result.h"

namespace telestrain {

// Where OpenGL comes from: both are Mesa's software rasteriser and give the same bytes.
enum class GlBackend { kOsMesa, kEgl };

// Mesa's llvmpipe takes pictures up to this side; beyond it they turn black without an error.
inline constexpr int kMostSide_px = 16384;

struct RenderOptions {
  // Size of every picture, up to kMostSide_px. The default is 170 mm, a page's text width, at 300
  // dpi, and leaves half a page for the report's text.
  int width_px = 2008;
  int height_px = 1240;
  // Texts and lines keep their size on paper whatever the resolution. 0: the width is 170 mm.
  int dots_per_inch = 0;
  // Nothing instead of white paper: an RGBA picture.
  bool transparent = false;
  GlBackend backend = GlBackend::kOsMesa;
  // One picture of the standard set by its name; empty: all.
  std::string view{};
  // Without a view: only what report.pdf shows of the set.
  bool only_reported = false;
  // The next three are for the view pipe_strain and films of the states; else they are refused.
  // State of the pipe: its index, its image or "largest" (the largest strain).
  std::string state = "largest";
  // What colours the pipe: name of a point array of pipe_NNN.vtp; empty: the axial strain.
  std::string quantity{};
  // Ends of the pipe's colour bar, in the quantity's unit, from -1e12 to 1e12; absent: from the
  // data.
  std::optional<std::array<double, 2>> range{};

  // The resolution with the default worked out.
  int Dpi() const;
};

// Fails (kUsage) with the option, what was found and the limit.
Status CheckRenderOptions(const RenderOptions& options);

// Whether RenderResults would find what it needs: fails as it does, and draws nothing.
Status CheckRender(const std::filesystem::path& results, const RenderOptions& options);

// Whether the folder's pictures are the whole standard set of its results. Fails (kBadInput) when a
// file of the folder is missing or malformed.
Result<bool> PicturesAreComplete(const std::filesystem::path& results);

// Writes the standard pictures of a results folder to `out` (empty: <results>/pictures), a folder,
// or, when options.view names a picture and `out` ends in ".png", that file: array.png, targets.png
// and so on (viz/picture_set.h has the list) and, when a strain was measured, the pipe's, of which
// pipe_strain.png shows one state and pipe_strain_000.png … every state with one common range.
// The whole set takes pictures of the set that no longer belong to the results out of the folder;
// a single view leaves all others alone. Files are written when all pictures are drawn: a picture
// that fails leaves the folder as it was. Needs no X server and touches nothing else. The same
// results give the same bytes, whatever the number of threads.
// Fails with kUsage when an option is out of range or names what is not there, with kBadInput when
// a file of the folder is missing or malformed, with kOutputFailed when rendering or writing fails.
// One call at a time does the work; more threads wait for each other.
Status RenderResults(const std::filesystem::path& results, const RenderOptions& options,
                     Console& console, const std::filesystem::path& out = {});

}  // namespace telestrain
