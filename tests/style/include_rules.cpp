#include "style/include_rules.h"

#include <algorithm>
#include <array>

namespace telestrain::style {
namespace {

// Bottom to top.
constexpr std::array kModules = {
    "base",        "geometry",    "optics",     "session", "target", "calibration", "diagnostics",
    "correlation", "measurement", "simulation", "study",   "viz",    "report",      "app"};

struct Forbidden {
  std::string_view module;
  std::string_view included;  // a module, named though the order would allow it
};
constexpr std::array kForbidden = {Forbidden{"simulation", "calibration"},
                                   Forbidden{"simulation", "measurement"},
                                   Forbidden{"viz", "calibration"},
                                   Forbidden{"viz", "correlation"},
                                   Forbidden{"report", "calibration"},
                                   Forbidden{"report", "correlation"},
                                   Forbidden{"report", "study"},
                                   Forbidden{"simulation", "diagnostics"},
                                   Forbidden{"report", "viz"}};

struct HeavyLibrary {
  std::string_view prefix;   // of what stands between the angle brackets
  std::string_view modules;  // that may include it, separated by blanks
};
constexpr std::array kHeavyLibraries = {
    HeavyLibrary{"opencv2/", "target correlation simulation viz"},
    HeavyLibrary{"ceres/", "calibration diagnostics measurement"},
    HeavyLibrary{"mrcal/", "diagnostics"},
    HeavyLibrary{"vtk", "viz"},
    HeavyLibrary{"GL/", "viz"},
    HeavyLibrary{"EGL/", "viz"},
    HeavyLibrary{"gif_lib", "viz"},
    HeavyLibrary{"hpdf", "report"},
    HeavyLibrary{"qpdf/", "report"},
    HeavyLibrary{"libxml/", "report"},
    HeavyLibrary{"kainjow/", "report"},
    HeavyLibrary{"png.h", "viz report target simulation"},
    HeavyLibrary{"toml++/", "base session"},
    HeavyLibrary{"CLI/", "app viz"},
    HeavyLibrary{"openssl/", "base report"},
};

// Headers that only their own module includes, as they stand in an #include; they may be heavy.
constexpr std::array<std::string_view, 24> kPrivateHeaders = {"calibration/board_residual.h",
                                                              "calibration/bundle_system.h",
                                                              "calibration/bundle_terms.h",
                                                              "calibration/corner_arrays.h",
                                                              "calibration/corner_gram.h",
                                                              "calibration/prior_residuals.h",
                                                              "diagnostics/pinhole_residual.h",
                                                              "report/pdf_font.h",
                                                              "report/pdf_objects.h",
                                                              "report/reading/attached_files.h",
                                                              "report/reading/page_drawing.h",
                                                              "report/reading/page_text.h",
                                                              "report/signature/opened_pdf.h",
                                                              "report/signature/openssl_objects.h",
                                                              "report/signature/pdf_update.h",
                                                              "target/pixel_decoders.h",
                                                              "viz/canvas.h",
                                                              "viz/desk/desk_style.h",
                                                              "viz/desk/desk_window.h",
                                                              "viz/desk/flat_sheet.h",
                                                              "viz/offscreen_window.h",
                                                              "viz/overlay.h",
                                                              "viz/part_actors.h",
                                                              "viz/window_keeper.h"};

int Rank(std::string_view module) {
  const auto found = std::find(kModules.begin(), kModules.end(), module);
  return found == kModules.end() ? -1 : static_cast<int>(found - kModules.begin());
}

bool IsForbidden(std::string_view module, std::string_view included) {
  return std::any_of(kForbidden.begin(), kForbidden.end(), [&](const Forbidden& pair) {
    return pair.module == module && pair.included == included;
  });
}

// Takes both src/calibration/a.h and calibration/a.h.
bool IsPrivateHeader(std::string_view path) {
  if (path.starts_with("src/")) path.remove_prefix(4);
  return std::find(kPrivateHeaders.begin(), kPrivateHeaders.end(), path) != kPrivateHeaders.end();
}

// What stands in `#include <…>` (open is '<') or `#include "…"`; empty for other lines.
std::string Included(std::string_view line, char open) {
  if (!line.starts_with("#include ")) return "";
  const std::size_t begin = line.find(open);
  if (begin == std::string_view::npos) return "";
  const std::size_t end = line.find(open == '<' ? '>' : open, begin + 1);
  return std::string(line.substr(begin + 1, end - begin - 1));
}

bool HasWord(std::string_view words, std::string_view word) {
  return (" " + std::string(words) + " ").find(" " + std::string(word) + " ") != std::string::npos;
}

}  // namespace

Findings CheckIncludeDirection(const SourceFile& file) {
  Findings findings;
  const std::string module = ModuleOf(file.path);
  if (module.empty()) return findings;
  const auto lines = Lines(file.text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string included = Included(lines[i], '"');
    if (included.empty()) continue;
    const std::string below = included.substr(0, included.find('/'));
    if (Rank(below) < 0 || included.find('/') == std::string::npos)
      findings.push_back(Finding(file, i + 1, "includes \"" + included + "\", want \"module/…\""));
    else if (Rank(below) > Rank(module) || IsForbidden(module, below))
      findings.push_back(Finding(file, i + 1, module + " must not include " + below));
    else if (below != module && IsPrivateHeader(included))
      findings.push_back(Finding(file, i + 1, included + " is private to " + below));
  }
  return findings;
}

Findings CheckHeavyHeaders(const SourceFile& file) {
  Findings findings;
  const std::string module = ModuleOf(file.path);
  if (module.empty()) return findings;
  const bool allowed_place = IsCpp(file.path) || IsPrivateHeader(file.path);
  const auto lines = Lines(file.text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string included = Included(lines[i], '<');
    for (const HeavyLibrary& library : kHeavyLibraries) {
      if (!included.starts_with(library.prefix)) continue;
      if (!allowed_place)
        findings.push_back(Finding(file, i + 1, "<" + included + "> belongs in a .cpp file"));
      if (!HasWord(library.modules, module))
        findings.push_back(Finding(file, i + 1, "<" + included + "> is not for " + module));
    }
  }
  return findings;
}

}  // namespace telestrain::style
