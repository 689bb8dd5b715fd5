#pragma once

#include <array>
#include <cstdint>

namespace mfar {

/// The distribution of times. It needs constant memory, because the daemon runs for months. Each
/// bucket is 2^(1/32) times as wide as the previous one, so that the error of a quantile is at most
/// 1.1 %.
class Histogram {
public:
    /// Adds a time [ms]. Zero, negative values and NaN are counted in the bucket of the shortest
    /// times, 1 us.
    void add(double ms);
    /// Returns the quantile q: the time [ms] that a share q of all times does not exceed. Returns 0
    /// if no times were added.
    [[nodiscard]] double quantile(double q) const;
    [[nodiscard]] std::uint64_t count() const { return count_; }

private:
    static constexpr int kBucketsPerOctave = 32;
    static constexpr int kOctaves = 27;  ///< the buckets cover 1 us to 134 s
    static constexpr double kLeastMs = 1e-3;

    std::array<std::uint32_t, kBucketsPerOctave * kOctaves> buckets_{};
    std::uint64_t count_ = 0;
};

}  // namespace mfar
