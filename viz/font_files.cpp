#include "viz/font_files.h"

#include <filesystem>

namespace telestrain::viz {

Result<FontFiles> FindFontFiles() {
  static constexpr const char* kFolders[] = {
      "/usr/share/fonts/truetype/dejavu",    // Debian, Ubuntu
      "/usr/share/fonts/dejavu-sans-fonts",  // Fedora
      "/usr/share/fonts/dejavu",             // older Fedora, openSUSE, Gentoo
      "/usr/share/fonts/truetype",           // openSUSE
      "/usr/share/fonts/TTF",                // Arch
      "/usr/local/share/fonts/dejavu",
  };
  std::string looked_in;
  for (const std::filesystem::path folder : kFolders) {
    const auto regular = folder / "DejaVuSans.ttf", bold = folder / "DejaVuSans-Bold.ttf";
    std::error_code code;
    if (std::filesystem::exists(regular, code) && std::filesystem::exists(bold, code))
      return FontFiles{regular.string(), bold.string()};
    looked_in += (looked_in.empty() ? "" : ", ") + folder.string();
  }
  return OutputFailed("pictures: DejaVuSans.ttf and DejaVuSans-Bold.ttf are wanted, looked in " +
                      looked_in + "; install the package fonts-dejavu-core");
}

}  // namespace telestrain::viz
