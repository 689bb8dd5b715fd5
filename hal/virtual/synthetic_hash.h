#pragma once

#include <cstdint>

namespace mfar::synthetic {

/// Mixes the bits of an integer; the result is the same on every machine. The constants are those
/// of splitmix64 (Steele et al. 2014).
[[nodiscard]] constexpr std::uint64_t mix(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

[[nodiscard]] constexpr std::uint64_t hash(std::uint64_t seed, std::int64_t a, std::int64_t b) {
    return mix(mix(seed ^ mix(static_cast<std::uint64_t>(a))) ^ static_cast<std::uint64_t>(b));
}

[[nodiscard]] constexpr double hashUnit(std::uint64_t h) {
    return static_cast<double>(h >> 11) * 0x1p-53;
}

class Random {
public:
    explicit constexpr Random(std::uint64_t seed) : state_(mix(seed)) {}
    constexpr std::uint64_t bits() { return mix(state_ += 0x9e3779b97f4a7c15ULL); }
    constexpr double unit() { return hashUnit(bits()); }
    constexpr double range(double from, double to) { return from + (to - from) * unit(); }
    constexpr int below(int n) { return static_cast<int>(bits() % static_cast<unsigned>(n)); }

private:
    std::uint64_t state_;
};

}  // namespace mfar::synthetic
