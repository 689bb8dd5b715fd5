#pragma once

#include <chrono>
#include <utility>

namespace mfar::eval {

/// Wall time of one call [ms].
template <class F>
[[nodiscard]] double wallMs(F&& call) {
    const auto begin = std::chrono::steady_clock::now();
    std::forward<F>(call)();
    const std::chrono::duration<double, std::milli> span = std::chrono::steady_clock::now() - begin;
    return span.count();
}

}  // namespace mfar::eval
