#pragma once

#include <functional>
#include <future>

namespace telestrain {

// The threads that a wish for 0 threads stands for, 1 to kMostThreads; one per core that the
// process may use until they are set. Set before any other thread works.
inline constexpr int kMostThreads = 256;
int DefaultThreads();
void SetDefaultThreads(int threads);

// How std::async starts what is done beside the caller's own work: on a thread, or with one thread
// when its result is asked for.
std::launch BesideOwnWork();

// Calls `work(i)` for every i in [0, count) on up to `threads` threads (0: DefaultThreads()).
// Each index is handled by exactly one call, so results written per index do not depend on the
// number of threads. The first exception by index is thrown again after all indices were handled.
//
// The threads are started once and stay, so that a call costs microseconds. A call from within
// `work` is handled on its thread alone, unless the outer call has one index or one thread. Calls
// from several threads share the pool. Thread-safe.
void ParallelFor(int count, int threads, const std::function<void(int)>& work);

}  // namespace telestrain
