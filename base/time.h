#pragma once

#include <chrono>
#include <compare>
#include <cstdint>
#include <ctime>

namespace mfar {

/// A point in time on CLOCK_MONOTONIC, in nanoseconds. Times from a recording are used unchanged:
/// they count from the recording's own epoch, and only their differences have a meaning.
struct Timestamp {
    std::int64_t ns = 0;

    auto operator<=>(const Timestamp&) const = default;

    [[nodiscard]] constexpr double seconds() const { return static_cast<double>(ns) * 1e-9; }

    [[nodiscard]] static constexpr Timestamp fromSeconds(double s) {
        return {static_cast<std::int64_t>(s * 1e9 + (s < 0 ? -0.5 : 0.5))};
    }

    [[nodiscard]] static Timestamp now() {
        timespec t{};
        clock_gettime(CLOCK_MONOTONIC, &t);
        return {static_cast<std::int64_t>(t.tv_sec) * 1'000'000'000 + t.tv_nsec};
    }
};

constexpr Timestamp operator+(Timestamp t, std::chrono::nanoseconds d) {
    return {t.ns + d.count()};
}
constexpr Timestamp operator-(Timestamp t, std::chrono::nanoseconds d) {
    return {t.ns - d.count()};
}
constexpr std::chrono::nanoseconds operator-(Timestamp a, Timestamp b) {
    return std::chrono::nanoseconds{a.ns - b.ns};
}

/// Time from `from` to `to` [s]; negative if `to` is earlier.
[[nodiscard]] constexpr double secondsBetween(Timestamp from, Timestamp to) {
    return static_cast<double>((to - from).count()) * 1e-9;
}

}  // namespace mfar
