#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

namespace telestrain {
namespace {

TEST(ParallelForTest, EveryIndexIsHandledOnceForAnyNumberOfThreads) {
  for (const int threads : {0, 1, 2, 3, 8, 200}) {
    std::vector<int> calls(100);
    ParallelFor(100, threads, [&](int i) { ++calls[static_cast<std::size_t>(i)]; });
    EXPECT_EQ(calls, std::vector<int>(100, 1)) << threads << " threads";
  }
}

TEST(ParallelForTest, NothingToDoIsDone) {
  ParallelFor(0, 4, [](int) { FAIL(); });
  ParallelFor(-1, 4, [](int) { FAIL(); });
}

TEST(ParallelForTest, ThrowsTheFirstExceptionByIndexAfterAllEnded) {
  for (const int threads : {1, 4}) {
    std::atomic<int> calls = 0;
    try {
      ParallelFor(50, threads, [&](int i) {
        ++calls;
        if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
      });
      FAIL() << "no exception";
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), "7");
    }
    EXPECT_EQ(calls, 50);
  }
}

}  // namespace
}  // namespace telestrain
