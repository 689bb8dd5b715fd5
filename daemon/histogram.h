#pragma once

#include <array>
#include <cstdint>

namespace mfar {

/// Buckets for times. Bucket 0 begins at 1 us. Each bucket is 2^(1/perOctave) times as wide as the
/// one before.
struct TimeBuckets {
    int perOctave;

    /// Returns the index of the bucket for a time. The index has a fraction. It is 0 for NaN and
    /// for times up to 1 us.
    [[nodiscard]] double of(double ms) const;
    /// Returns the time in the middle of a bucket [ms].
    [[nodiscard]] double middleMs(double bucket) const;
};

/// The distribution of times. It needs constant memory, because the daemon runs for months. Each
/// bucket is 2^(1/32) times as wide as the previous one, so that the error of a quantile is at most
/// 1.1 %.
class Histogram {
public:
    /// Adds a time [ms]. Zero, negative values and NaN count as 1 us.
    void add(double ms);
    /// Returns the quantile q: the time [ms] that a share q of all times does not exceed. Returns 0
    /// without times.
    [[nodiscard]] double quantile(double q) const;
    [[nodiscard]] std::uint64_t count() const { return count_; }

private:
    static constexpr TimeBuckets kBuckets{32};
    static constexpr int kOctaves = 27;  ///< the buckets cover 1 us to 134 s

    std::array<std::uint32_t, kBuckets.perOctave * kOctaves> buckets_{};
    std::uint64_t count_ = 0;
};

}  // namespace mfar
