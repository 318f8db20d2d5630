#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <stdexcept>
#include <string>
#include <thread>
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

TEST(ParallelForTest, ACallWithinACallIsHandledOnItsThread) {
  std::vector<std::vector<int>> calls(20, std::vector<int>(30));
  ParallelFor(20, 4, [&](int i) {
    const auto outer = std::this_thread::get_id();
    ParallelFor(30, 4, [&](int k) {
      EXPECT_EQ(std::this_thread::get_id(), outer);
      ++calls[i][k];
    });
  });
  EXPECT_EQ(calls, std::vector(20, std::vector<int>(30, 1)));
}

// All indices wait for each other: with fewer threads the call would never end.
void ExpectThreads(int threads) {
  std::latch all_there(threads);
  ParallelFor(threads, threads, [&](int) { all_there.arrive_and_wait(); });
}

TEST(ParallelForTest, WorksOnAsManyThreadsAsAsked) {
  for (const int threads : {2, 5, 2, 7}) ExpectThreads(threads);
}

TEST(ParallelForTest, NoWishIsTheDefault) {
  const int before = DefaultThreads();
  EXPECT_GE(before, 1);
  SetDefaultThreads(1);
  EXPECT_EQ(BesideOwnWork(), std::launch::deferred);
  ParallelFor(9, 0, [caller = std::this_thread::get_id()](int) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
  });
  SetDefaultThreads(5);
  EXPECT_EQ(BesideOwnWork(), std::launch::async);
  std::latch all_there(5);
  ParallelFor(5, 0, [&](int) { all_there.arrive_and_wait(); });
  SetDefaultThreads(before);
}

TEST(ParallelForTest, AnOuterCallOfOneIndexLeavesTheThreadsToTheInnerOne) {
  ParallelFor(1, 4, [](int) { ExpectThreads(3); });
  ParallelFor(5, 1, [](int) { ExpectThreads(3); });
}

TEST(ParallelForTest, AfterAnExceptionThreadsAreThereAgain) {
  EXPECT_THROW(ParallelFor(4, 4, [](int) { throw std::runtime_error("no"); }), std::runtime_error);
  ExpectThreads(4);
}

TEST(ParallelForTest, CallsFromSeveralThreadsDoNotMix) {
  std::vector<std::jthread> callers;
  std::atomic<int> wrong = 0;
  for (int caller = 0; caller < 4; ++caller)
    callers.emplace_back([&] {
      for (int round = 0; round < 300; ++round) {
        std::vector<int> calls(7);
        ParallelFor(7, 3, [&](int i) { ++calls[static_cast<std::size_t>(i)]; });
        wrong += calls != std::vector<int>(7, 1);
      }
    });
  callers.clear();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace telestrain
