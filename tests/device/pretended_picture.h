#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace mfar::pretended {

// Every picture contains a stamp: its time in milliseconds (24 bits) and 8 check bits. Bits are
// dark and bright rectangles in two rows of 16 across the upper half. They can be read from the
// displayed picture.
constexpr int kStampColumns = 16, kStampRows = 2;
constexpr int kStampBits = 24;
constexpr std::uint8_t kDark = 40, kBright = 210;

inline std::uint32_t stampBits(std::int64_t ms) {
    const auto time = static_cast<std::uint32_t>(ms) & ((1U << kStampBits) - 1);
    // The constant 0xa5 makes the stamp of a black picture invalid.
    const std::uint32_t check = (((time * 0x9e3779b1U) >> 24U) ^ 0xa5U) & 0xffU;
    return time << 8U | check;
}

inline void paint(std::span<std::uint8_t> yuyv, std::uint64_t number) {
    std::uint64_t random = number * 0x9e3779b97f4a7c15ULL;
    const auto gray = static_cast<std::uint8_t>(64 + number % 64);
    for (std::size_t at = 0; at + 1 < yuyv.size(); at += 2) {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        yuyv[at] = static_cast<std::uint8_t>(gray + (random & 15));
        yuyv[at + 1] = 128;
    }
}

/// Writes the stamp into a YUYV picture of this width, unless the picture is too small.
inline void stamp(std::span<std::uint8_t> yuyv, int width, std::int64_t ms) {
    const int height = width > 0 ? static_cast<int>(yuyv.size()) / (2 * width) : 0;
    if (width < kStampColumns || height < 2 * kStampRows) return;
    const std::uint32_t bits = stampBits(ms);
    for (int y = 0; y < height / 2; ++y)
        for (int x = 0; x < width; ++x) {
            const int column = std::min(x * kStampColumns / width, kStampColumns - 1);
            const int row = std::min(y * kStampRows / (height / 2), kStampRows - 1);
            const bool one =
                (bits >> static_cast<unsigned>(row * kStampColumns + column) & 1U) != 0;
            yuyv[2 * (static_cast<std::size_t>(y) * width + x)] = one ? kBright : kDark;
        }
}

/// Reads the stamp from luma, one byte per pixel. Returns nothing if there is no valid stamp.
inline std::optional<std::int64_t> stampOf(std::span<const std::uint8_t> luma, int width) {
    const int height = width > 0 ? static_cast<int>(luma.size()) / width : 0;
    std::uint32_t bits = 0;
    for (int row = 0; row < kStampRows; ++row)
        for (int column = 0; column < kStampColumns; ++column) {
            const int x = (2 * column + 1) * width / (2 * kStampColumns);
            const int y = (2 * row + 1) * (height / 2) / (2 * kStampRows);
            if (luma[static_cast<std::size_t>(y) * width + x] > (kDark + kBright) / 2)
                bits |= 1U << static_cast<unsigned>(row * kStampColumns + column);
        }
    const std::int64_t ms = bits >> 8U;
    if (stampBits(ms) != bits) return std::nullopt;
    return ms;
}

}  // namespace mfar::pretended
