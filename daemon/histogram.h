#pragma once

#include <array>
#include <cstdint>

namespace mfar {

/// Distribution of times, of constant memory use, as the daemon runs for months. Buckets grow by
/// 2^(1/32), so that a quantile is at most 1.1 % off.
class Histogram {
public:
    /// Milliseconds; zero, negative and NaN go to the smallest bucket, 1 us.
    void add(double ms);
    /// The value that a share q of all values does not exceed; 0 without values.
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
