#pragma once

#include "tests/measure/eval/stopwatch.h"

#include <algorithm>
#include <ctime>
#include <thread>
#include <utility>

namespace mfar::bench {

enum class Clock {
    Wall,
    /// Processor time of all threads, divided by the number of cores. An otherwise idle machine
    /// would need this time if the work were spread evenly over its cores.
    Processor,
};

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
