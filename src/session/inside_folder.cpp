#include "session/inside_folder.h"

#include <system_error>

#include "base/utf8.h"

namespace telestrain {

namespace fs = std::filesystem;

Result<fs::path> PathInside(const std::string& subject, const fs::path& folder,
                            const fs::path& inside) {
  const fs::path plain = inside.lexically_normal();
  if (plain.empty() || plain.is_absolute() || *plain.begin() == "..")
    return BadInput(subject +
                    " leaves the session folder; copy it into the folder and write its path "
                    "relative to it");
  std::error_code code;
  const fs::path root = fs::weakly_canonical(folder / ".", code);
  const fs::path file = code ? fs::path() : fs::weakly_canonical(folder / plain, code);
  if (code) return BadInput(subject + " cannot be found: " + code.message() + "; correct its path");
  const fs::path relative = file.lexically_relative(root);
  if (relative.empty() || *relative.begin() == "..")
    return BadInput(subject + " leaves the session folder by a symbolic link to " +
                    PrintableText(file.string()) + "; copy the file itself into the folder");
  return relative;
}

Status StaysInside(const fs::path& file) {
  const std::string name = PrintableText(file.string()) + ": the file";
  const auto inside = PathInside(name, file.parent_path(), file.filename());
  return inside ? Status() : Status(inside.error());
}

}  // namespace telestrain
