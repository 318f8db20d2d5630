#include "app/export_files.h"

#include <set>

#include "base/files.h"
#include "base/numbers.h"
#include "viz/export/paraview.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

// An earlier export of more boards or states left pieces that the new index does not name.
Status RemoveOldPieces(const fs::path& folder, const NamedFiles& files) {
  std::set<std::string> old;
  std::error_code code;
  for (fs::directory_iterator entry(folder / "scene", code), end; !code && entry != end;
       entry.increment(code))
    if (const std::string name = entry->path().filename().string(); viz::IsParaViewPiece(name))
      old.insert("scene/" + name);
  for (const auto& [name, bytes] : files) old.erase(name);
  for (const std::string& name : old)
    if (const fs::path path = folder / name; !fs::remove(path, code) && code)
      return CannotRemove(path, "an old piece", code.value());
  return {};
}

}  // namespace

// All bytes are there before the first is written.
Result<std::string> WriteExportedFiles(const fs::path& folder, const NamedFiles& files,
                                       bool is_index) {
  std::string names;
  std::size_t pieces = 0;
  TELESTRAIN_RETURN_IF_ERROR(EnsureFolder(folder));
  for (const auto& [name, bytes] : files) {
    const fs::path path = folder / name;
    const bool piece = name.starts_with("scene/");
    if (piece && pieces++ == 0) TELESTRAIN_RETURN_IF_ERROR(EnsureFolder(path.parent_path()));
    TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(path, bytes));
    if (!piece) names += name + " ";
  }
  if (is_index) TELESTRAIN_RETURN_IF_ERROR(RemoveOldPieces(folder, files));
  if (pieces > 0) names += "(" + CountText(pieces, "piece") + " below scene) ";
  return names;
}

}  // namespace telestrain
