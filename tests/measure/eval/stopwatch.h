#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

namespace mfar::eval {

template <class F>
[[nodiscard]] double wallMs(F&& call) {
    const auto begin = std::chrono::steady_clock::now();
    std::forward<F>(call)();
    const std::chrono::duration<double, std::milli> span = std::chrono::steady_clock::now() - begin;
    return span.count();
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
