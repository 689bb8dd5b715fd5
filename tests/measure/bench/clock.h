#pragma once

#include "tests/measure/eval/stopwatch.h"

#include <algorithm>
#include <ctime>
#include <thread>
#include <utility>

namespace mfar::bench {

/// How the run time is measured.
enum class Clock {
    Wall,
    /// Processor time of all threads, divided by the number of cores. On a shared machine this is
    /// the time that the run would take alone if its work were spread evenly over the cores.
    Processor,
};

/// Time of one call [ms].
template <class F>
[[nodiscard]] double msOf(Clock clock, F&& call) {
    if (clock == Clock::Wall) return eval::wallMs(std::forward<F>(call));
    const auto now = [] {
        timespec t{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
        return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
    };
    const double begin = now();
    std::forward<F>(call)();
    return (now() - begin) / std::max(1U, std::thread::hardware_concurrency());
}

}  // namespace mfar::bench
