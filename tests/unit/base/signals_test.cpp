#include "base/signals.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

namespace telestrain {
namespace {

using namespace std::chrono_literals;

// What a child process that handles signals leaves: its wait status.
template <typename Body>
int StatusOf(const Body& body) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGINT, SIG_DFL);  // shells ignore it for what runs in the background
    HandleSignals();
    body();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

TEST(SignalsDeathTest, EndTheProcessWith128AndTheirNumber) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    const int status = StatusOf([&] {
      ::kill(::getpid(), number);
      std::this_thread::sleep_for(10s);
    });
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 128 + number) << SignalName(number);
  }
}

TEST(SignalsDeathTest, WhatIsToBeDoneIsDoneTheLatestFirst) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const auto say = [&](char c) {
    return [&ends, c](int) {
      EXPECT_EQ(::write(ends[1], &c, 1), 1);
      return AfterSignal::kEnd;
    };
  };
  StatusOf([&] {
    const AtSignal first(say('1'));
    { const AtSignal gone(say('x')); }
    const AtSignal second(say('2'));
    ::kill(::getpid(), SIGTERM);
    std::this_thread::sleep_for(10s);
  });
  std::string said(2, ' ');
  ASSERT_EQ(::read(ends[0], said.data(), 2), 2);
  EXPECT_EQ(said, "21");
}

TEST(SignalsDeathTest, OneThatIsTakenDoesNotEnd) {
  const int status = StatusOf([] {
    std::atomic<int> taken = 0;
    const AtSignal first([](int) { return AfterSignal::kEnd; });
    const AtSignal take([&](int) { return ++taken == 1 ? AfterSignal::kGoOn : AfterSignal::kEnd; });
    ::kill(::getpid(), SIGINT);
    std::this_thread::sleep_for(200ms);
    if (taken != 1) ::_exit(1);
    ::kill(::getpid(), SIGINT);
    std::this_thread::sleep_for(10s);
  });
  EXPECT_EQ(WEXITSTATUS(status), 128 + SIGINT);
}

TEST(SignalsDeathTest, WaitForWhatMustBeDoneWhole) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const int status = StatusOf([&] {
    const NoSignalNow outer;
    ::kill(::getpid(), SIGTERM);
    std::this_thread::sleep_for(200ms);
    const NoSignalNow inner;
    EXPECT_EQ(::write(ends[1], "!", 1), 1);
  });
  EXPECT_TRUE(WIFEXITED(status));
  char said = 0;
  EXPECT_EQ(::read(ends[0], &said, 1), 1);
}

TEST(SignalsDeathTest, TheIgnoredStayIgnoredAndLostReadersAreErrors) {
  const int status = StatusOf([] {
    int ends[2];
    if (::pipe(ends) != 0) ::_exit(1);
    ::close(ends[0]);
    if (::write(ends[1], "x", 1) != -1 || errno != EPIPE) ::_exit(2);
    ::_exit(3);
  });
  EXPECT_EQ(WEXITSTATUS(status), 3);
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGHUP, SIG_IGN);
    HandleSignals();
    ::kill(::getpid(), SIGHUP);
    std::this_thread::sleep_for(200ms);
    ::_exit(7);
  }
  int ignored = 0;
  ::waitpid(child, &ignored, 0);
  EXPECT_EQ(WEXITSTATUS(ignored), 7);
}

}  // namespace
}  // namespace telestrain
