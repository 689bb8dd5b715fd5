#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <thread>
#include <utility>

namespace mfar::eval {

template <class F>
[[nodiscard]] double wallMs(F&& call) {
    const auto begin = std::chrono::steady_clock::now();
    std::forward<F>(call)();
    const std::chrono::duration<double, std::milli> span = std::chrono::steady_clock::now() - begin;
    return span.count();
}

enum class Clock {
    Wall,
    /// Processor time of all threads, divided by the number of cores. An otherwise idle machine
    /// would need this time if the work were spread evenly over its cores.
    Processor,
};

template <class F>
[[nodiscard]] double msOf(Clock clock, F&& call) {
    if (clock == Clock::Wall) return wallMs(std::forward<F>(call));
    const auto now = [] {
        timespec t{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
        return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
    };
    const double begin = now();
    std::forward<F>(call)();
    return (now() - begin) / std::max(1U, std::thread::hardware_concurrency());
}

/// The clock of FlowMethod::Result::ms, and thus of depth methods that use a FlowMethod.
inline Clock methodClock = Clock::Wall;

template <class F>
[[nodiscard]] double methodMs(F&& call) {
    return msOf(methodClock, std::forward<F>(call));
}

template <class F>
[[nodiscard]] double medianOfThree(F&& call) {
    std::array<double, 3> values{};
    for (double& value : values)
        value = call();
    std::sort(values.begin(), values.end());
    return values[1];
}

}  // namespace mfar::eval
