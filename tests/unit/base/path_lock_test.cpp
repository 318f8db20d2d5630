#include "base/path_lock.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

#include "tests/unit/base/scratch_folder.h"

namespace telestrain {
namespace {

TEST(PathLock, TheSecondWaitsUntilTheFirstIsGone) {
  const ScratchFolder scratch("telestrain_path_lock_");
  for (const auto& path : {scratch.path(), scratch.path() / "log.jsonl"}) {
    auto taken = PathLock::Take(path, "none");
    ASSERT_TRUE(taken.ok()) << taken.error().message;
    std::optional<PathLock> first(std::move(taken).value());
    std::atomic<bool> entered = false;
    std::thread other([&] {
      const auto second = PathLock::Take(path, "none");
      EXPECT_TRUE(second.ok());
      entered = true;
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_FALSE(entered) << path;
    first.reset();
    other.join();
    EXPECT_TRUE(entered) << path;
  }
}

TEST(PathLock, WhoDoesNotWaitIsToldWhoHoldsIt) {
  const ScratchFolder scratch("telestrain_path_lock_");
  const auto first = PathLock::TakeAtOnce(scratch.path(), "none");
  ASSERT_TRUE(first.ok());
  const auto second = PathLock::TakeAtOnce(scratch.path(), "wait");
  ASSERT_FALSE(second.ok());
  EXPECT_EQ(second.error().kind, ErrorKind::kOutputFailed);
  EXPECT_EQ(second.error().message, scratch.path().string() + ": is in use by process " +
                                        std::to_string(::getpid()) + "; wait");
  EXPECT_TRUE(std::filesystem::is_empty(scratch.path()));
}

TEST(PathLock, APlaceThatIsNotThereIsAnErrorWithTheRemedy) {
  const auto lock = PathLock::Take("/nowhere/log.jsonl", "name another log");
  ASSERT_FALSE(lock.ok());
  EXPECT_EQ(lock.error().kind, ErrorKind::kOutputFailed);
  EXPECT_EQ(
      lock.error().message,
      "/nowhere/log.jsonl: cannot be locked: No such file or directory; choose a place on a local "
      "disk that you may read and write");
}

}  // namespace
}  // namespace telestrain
