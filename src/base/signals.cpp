#include "base/signals.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <mutex>
#include <shared_mutex>
#include <thread>
#include <utility>

namespace telestrain {
namespace {

constexpr std::array kEndingSignals = {std::pair{SIGINT, "SIGINT"}, std::pair{SIGTERM, "SIGTERM"},
                                       std::pair{SIGHUP, "SIGHUP"}};
constexpr int kExitOfSignal = 128;  // as shells have it
// A disk or a lock that hangs must not make the program deaf.
constexpr int kMostPatience_s = 5;

struct Shared {
  std::shared_timed_mutex whole;  // held shared by what must be done whole
  std::mutex mutex;
  std::list<std::function<AfterSignal(int)>> acts;  // under the mutex
};

// Never destroyed: the waiting thread outlives main.
Shared& TheShared() {
  static Shared* const shared = new Shared;
  return *shared;
}

// Nested ones take the mutex once; what is done at a signal has it already.
thread_local int whole_depth = 0;

AfterSignal ActAt(int number) {
  Shared& shared = TheShared();
  const std::lock_guard lock(shared.mutex);
  for (auto act = shared.acts.rbegin(); act != shared.acts.rend(); ++act)
    if ((*act)(number) == AfterSignal::kGoOn) return AfterSignal::kGoOn;
  return AfterSignal::kEnd;
}

volatile sig_atomic_t ending_number = 0;

// What is to be done at the signal takes too long.
void EndAtAlarm(int) { ::_exit(kExitOfSignal + ending_number); }

[[noreturn]] void AwaitSignals(const sigset_t& signals) {
  whole_depth = 1;
  while (true) {
    int number = 0;
    if (::sigwait(&signals, &number) != 0) continue;
    std::unique_lock lock(TheShared().whole, std::defer_lock);
    [[maybe_unused]] const bool in_time = lock.try_lock_for(std::chrono::seconds(kMostPatience_s));
    ending_number = number;
    ::alarm(kMostPatience_s);
    if (ActAt(number) == AfterSignal::kEnd) ::_exit(kExitOfSignal + number);
    ::alarm(0);
  }
}

std::thread::native_handle_type waiting_thread;

// Threads that libraries made before main do not have the signals blocked.
void Forward(int number) { ::pthread_kill(waiting_thread, number); }

bool IsIgnored(int number) {
  struct sigaction action {};
  return ::sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

void OpenStandardStreams() {
  for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(number, F_GETFD) < 0 && errno == EBADF)
      ::open("/dev/null", number == STDIN_FILENO ? O_RDONLY : O_WRONLY);
}

}  // namespace

void HandleSignals() {
  OpenStandardStreams();
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);
  ::signal(SIGALRM, EndAtAlarm);
  sigset_t signals;
  sigemptyset(&signals);
  for (const auto& [number, name] : kEndingSignals)
    if (!IsIgnored(number)) sigaddset(&signals, number);
  // Threads that are made from now on inherit it.
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  try {
    std::thread waiting([signals] { AwaitSignals(signals); });
    waiting_thread = waiting.native_handle();
    waiting.detach();
  } catch (const std::system_error&) {  // no thread to be had: a signal ends the process at once
    ::pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    return;
  }
  struct sigaction forward {};
  forward.sa_handler = Forward;
  forward.sa_flags = SA_RESTART;
  for (const auto& [number, name] : kEndingSignals)
    if (sigismember(&signals, number) == 1) ::sigaction(number, &forward, nullptr);
}

std::string SignalName(int number) {
  for (const auto& [known, name] : kEndingSignals)
    if (known == number) return name;
  return "signal " + std::to_string(number);
}

AtSignal::AtSignal(std::function<AfterSignal(int)> act) {
  const std::lock_guard lock(TheShared().mutex);
  place_ = TheShared().acts.insert(TheShared().acts.end(), std::move(act));
}

AtSignal::~AtSignal() {
  const std::lock_guard lock(TheShared().mutex);
  TheShared().acts.erase(place_);
}

NoSignalNow::NoSignalNow() {
  if (whole_depth++ == 0) TheShared().whole.lock_shared();
}

NoSignalNow::~NoSignalNow() {
  if (--whole_depth == 0) TheShared().whole.unlock_shared();
}

}  // namespace telestrain
