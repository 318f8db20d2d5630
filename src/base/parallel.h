#pragma once

#include <functional>

namespace telestrain {

// Calls `work(i)` for every i in [0, count) on up to `threads` threads (0: one per core).
// Each index is handled by exactly one call, so results written per index do not depend on the
// number of threads. The first exception by index is thrown again after all indices were handled.
//
// The threads are started once and stay, so that a call costs microseconds. A call from within
// `work` is handled on its thread alone, unless the outer call has one index or one thread. Calls
// from several threads share the pool. Thread-safe.
void ParallelFor(int count, int threads, const std::function<void(int)>& work);

}  // namespace telestrain
