#include "app/results_lock.h"

#include <sys/stat.h>

#include <map>
#include <mutex>
#include <utility>

#include "base/files.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRemedy = "wait until that has ended, or use another results folder";

}  // namespace

Result<ResultsLock> ResultsLock::Take(const fs::path& results) {
  using Place = std::pair<unsigned long, unsigned long>;  // device and inode
  static std::mutex mutex;
  static std::map<Place, std::weak_ptr<const PathLock>> held;

  const fs::path folder = results.empty() ? fs::path(".") : results;
  struct stat facts {};
  if (::stat(folder.c_str(), &facts) != 0 || !S_ISDIR(facts.st_mode)) return ResultsLock(nullptr);
  const std::lock_guard guard(mutex);
  std::weak_ptr<const PathLock>& known = held[{facts.st_dev, facts.st_ino}];
  if (auto shared = known.lock()) return ResultsLock(std::move(shared));
  TELESTRAIN_ASSIGN_OR_RETURN(PathLock lock, PathLock::TakeAtOnce(folder, kRemedy));
  for (const fs::path& place : {folder, folder / "pictures"})
    TELESTRAIN_RETURN_IF_ERROR(RemoveTemporaries(place));
  auto shared = std::make_shared<const PathLock>(std::move(lock));
  known = shared;
  return ResultsLock(std::move(shared));
}

}  // namespace telestrain
