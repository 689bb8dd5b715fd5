#pragma once

#include <array>
#include <cstdint>

namespace mfar {

/// Distribution of times, in fixed memory for a daemon that runs for months. Buckets grow by
/// 2^(1/32), so that a quantile is at most 1.1 % off.
class Histogram {
public:
    /// Milliseconds; what is not positive counts as the smallest, 1 us.
    void add(double ms);
    /// The value that the share q of all values does not exceed; 0 when there is none.
    [[nodiscard]] double quantile(double q) const;
    [[nodiscard]] std::uint64_t count() const { return count_; }

private:
    static constexpr int kBucketsPerOctave = 32;
    static constexpr int kOctaves = 27;  ///< 1 us to 134 s
    static constexpr double kLeastMs = 1e-3;

    std::array<std::uint32_t, kBucketsPerOctave * kOctaves> buckets_{};
    std::uint64_t count_ = 0;
};

}  // namespace mfar
