#pragma once

#include <Eigen/Core>

#include <array>
#include <bit>
#include <cstdint>

namespace mfar {

/// Integer hash in which each input bit affects all output bits (Wellons, "lowbias32").
[[nodiscard]] constexpr std::uint32_t mixedBits(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7FEB352DU;
    x ^= x >> 15;
    x *= 0x846CA68BU;
    return x ^ (x >> 16);
}

[[nodiscard]] constexpr std::uint32_t reversedBits(std::uint32_t x) {
    x = (x >> 16) | (x << 16);
    x = ((x & 0xFF00FF00U) >> 8) | ((x & 0x00FF00FFU) << 8);
    x = ((x & 0xF0F0F0F0U) >> 4) | ((x & 0x0F0F0F0FU) << 4);
    x = ((x & 0xCCCCCCCCU) >> 2) | ((x & 0x33333333U) << 2);
    return ((x & 0xAAAAAAAAU) >> 1) | ((x & 0x55555555U) << 1);
}

/// Nested uniform (Owen) scrambling of a number with reversed bits. A hash of the seed and the bits
/// below a bit decides whether the bit is flipped (Laine and Karras 2011, Burley 2020; multipliers
/// by Vegdahl).
[[nodiscard]] constexpr std::uint32_t scrambledReversed(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3D20ADEAU;
    x += seed;
    x *= (seed >> 16) | 1U;
    x ^= x * 0x05526C56U;
    return x ^ (x * 0x53A22864U);
}

/// Returns the position of sample `index` after an Owen scramble of the indices. Aligned blocks of
/// 2^k indices stay together.
[[nodiscard]] constexpr std::uint32_t shuffledIndex(std::uint32_t index, std::uint32_t seed) {
    return reversedBits(scrambledReversed(reversedBits(index), seed));
}

/// Returns point `index` of the two-dimensional Sobol sequence. Each coordinate is a 32-bit
/// fraction in reversed bit order. The second dimension's generator matrix is Pascal's triangle
/// modulo 2, applied in five steps (Ahmed 2024).
[[nodiscard]] constexpr std::array<std::uint32_t, 2> sobolReversed(std::uint32_t index) {
    std::uint32_t y = index;
    y ^= (y & 0xAAAAAAAAU) >> 1;
    y ^= (y & 0xCCCCCCCCU) >> 2;
    y ^= (y & 0xF0F0F0F0U) >> 4;
    y ^= (y & 0xFF00FF00U) >> 8;
    y ^= y >> 16;
    return {index, y};
}

/// Random number pairs of one sample of a pixel, from a (0, 2)-sequence in base 2. Each pair is
/// Owen-scrambled and shuffled separately (padding, Kollig and Keller 2002; Burley 2020, section
/// 5). Equal seed, pixel, sample and dimension give equal numbers.
class PixelSampler {
public:
    /// If `independent` is true, the pairs are independent uniform numbers.
    PixelSampler(std::uint32_t seed, std::uint32_t pixel, std::uint32_t sample, bool independent)
        : seed_(mixedBits(pixel ^ mixedBits(seed + 0x9E3779B9U))), sample_(sample),
          independent_(independent) {}

    [[nodiscard]] std::uint32_t number() const { return sample_; }
    /// Returns the pair with index `dimension`, in [0, 1)^2.
    [[nodiscard]] Eigen::Vector2f pair(std::uint32_t dimension) const {
        const std::uint32_t seed = mixedBits(seed_ + dimension * 0x9E3779B9U);
        if (independent_) {
            const std::uint32_t x = mixedBits(seed ^ mixedBits(sample_ + 0x85EBCA6BU));
            return {unit(x), unit(mixedBits(x + 0xC2B2AE35U))};
        }
        const auto [x, y] = sobolReversed(shuffledIndex(sample_, seed));
        const std::uint32_t first = mixedBits(seed + 1), second = mixedBits(seed + 2);
        return {unit(reversedBits(scrambledReversed(x, first))),
                unit(reversedBits(scrambledReversed(y, second)))};
    }

private:
    static float unit(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24F; }

    std::uint32_t seed_, sample_;
    bool independent_;
};

}  // namespace mfar
