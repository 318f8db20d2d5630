#pragma once

#include <functional>

namespace telestrain {

// Calls `work(i)` for every i in [0, count) on up to `threads` threads (0: one per core).
// Each index is handled by exactly one call, so results written per index do not depend on the
// number of threads. The first exception by index is thrown again after all threads ended.
void ParallelFor(int count, int threads, const std::function<void(int)>& work);

}  // namespace telestrain
