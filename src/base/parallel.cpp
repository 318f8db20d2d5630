#include "base/parallel.h"

#include <openssl/crypto.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <limits>
#include <list>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace telestrain {
namespace {

// Threads beside the caller's.
constexpr int kMostWorkers = kMostThreads - 1;
// Waking a sleeping thread costs tens of microseconds, so waiting starts awake.
constexpr std::chrono::microseconds kAwake{20};

thread_local bool inside_a_call = false;

// 0: not set.
std::atomic<int> default_threads{0};

// Returns whether `done` came true while awake.
template <class Done>
bool WaitAwake(const Done& done) {
  const auto end = std::chrono::steady_clock::now() + kAwake;
  do {
    if (done()) return true;
    std::this_thread::yield();
  } while (std::chrono::steady_clock::now() < end);
  return done();
}

// The indices of one call.
class Job {
 public:
  Job(int count, const std::function<void(int)>& work) : count_(count), work_(work) {}

  void Run() {
    for (int i = next_++; i < count_; i = next_++) {
      try {
        work_(i);
      } catch (...) {
        const std::lock_guard lock(failure_mutex_);
        if (i < failed_) failure_ = std::current_exception();
        failed_ = std::min(failed_, i);
      }
    }
  }
  // After all threads left.
  void RethrowFirst() const {
    if (failure_) std::rethrow_exception(failure_);
  }

  int wanted = 0;               // threads that may still join; under the pool's mutex
  std::atomic<int> running{0};  // threads beside the caller's

 private:
  const int count_;
  const std::function<void(int)>& work_;
  std::atomic<int> next_{0};
  std::mutex failure_mutex_;
  int failed_ = std::numeric_limits<int>::max();
  std::exception_ptr failure_;
};

// Threads that stay between calls. The caller works too and waits only for threads that joined: a
// call ends though all others are busy. A forked process has none of them, and works alone.
class ThreadPool {
 public:
  ~ThreadPool() {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
      ++changes_;
    }
    wake_.notify_all();
    for (std::thread& worker : workers_) worker.join();
  }

  bool HasItsThreads() const { return process_ == getpid(); }

  void Run(int helpers, Job& job) {
    Announce(std::min(helpers, kMostWorkers), job);
    job.Run();
    std::unique_lock lock(mutex_);
    jobs_.remove(&job);
    lock.unlock();
    const auto all_left = [&] { return job.running == 0; };
    if (WaitAwake(all_left)) return;
    lock.lock();
    left_.wait(lock, all_left);
  }

 private:
  void Announce(int helpers, Job& job) {
    const std::lock_guard lock(mutex_);
    try {
      while (static_cast<int>(workers_.size()) < helpers) workers_.emplace_back([this] { Work(); });
    } catch (const std::system_error&) {  // no more threads to be had: those that are do the work
    }
    job.wanted = helpers;
    jobs_.push_back(&job);
    ++changes_;
    for (int i = 0; i < std::min(helpers, asleep_); ++i) wake_.notify_one();
  }

  void Work() {
    inside_a_call = true;
    std::unique_lock lock(mutex_);
    while (!ending_) {
      if (Job* job = Join()) {
        lock.unlock();
        job->Run();
        lock.lock();
        if (--job->running == 0) left_.notify_all();
      } else {
        AwaitChange(lock);
      }
    }
  }

  // A job that wants another thread, or none.
  Job* Join() {
    for (Job* job : jobs_) {
      if (job->wanted == 0) continue;
      --job->wanted;
      ++job->running;
      return job;
    }
    return nullptr;
  }

  void AwaitChange(std::unique_lock<std::mutex>& lock) {
    const std::uint64_t seen = changes_;
    const auto changed = [&] { return changes_ != seen; };
    lock.unlock();
    const bool now = WaitAwake(changed);
    lock.lock();
    if (now) return;
    ++asleep_;
    wake_.wait(lock, changed);
    --asleep_;
  }

  const pid_t process_ = getpid();
  std::mutex mutex_;
  std::condition_variable wake_, left_;
  std::atomic<std::uint64_t> changes_{0};  // calls announced, and the end
  bool ending_ = false;
  int asleep_ = 0;
  std::list<Job*> jobs_;
  std::vector<std::thread> workers_;
};

// Made at the first call and ended by the process that made it: a forked one would wait for threads
// that it does not have.
ThreadPool& Pool() {
  static ThreadPool* const pool = [] {
    // OpenSSL's end, which takes what it keeps of every thread, comes after that of the threads. It
    // begins with the first option that is asked of it.
    ::OPENSSL_init_crypto(OPENSSL_INIT_ADD_ALL_DIGESTS, nullptr);
    auto* made = new ThreadPool;
    std::atexit([] {
      if (Pool().HasItsThreads()) delete &Pool();
    });
    return made;
  }();
  return *pool;
}

}  // namespace

int DefaultThreads() {
  // Of the processors that the process may use, as hardware_concurrency() counts them.
  static const int cores =
      std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostThreads);
  const int threads = default_threads;
  return threads > 0 ? threads : cores;
}

void SetDefaultThreads(int threads) { default_threads = std::clamp(threads, 1, kMostThreads); }

std::launch BesideOwnWork() {
  return DefaultThreads() > 1 ? std::launch::async : std::launch::deferred;
}

void ParallelFor(int count, int threads, const std::function<void(int)>& work) {
  if (count <= 0) return;
  Job job(count, work);
  const int most = std::min(threads > 0 ? threads : DefaultThreads(), count);
  if (most == 1 || inside_a_call || !Pool().HasItsThreads()) {
    job.Run();
  } else {
    inside_a_call = true;
    Pool().Run(most - 1, job);
    inside_a_call = false;
  }
  job.RethrowFirst();
}

}  // namespace telestrain
