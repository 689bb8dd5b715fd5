#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

namespace mfar {

/// The tone curve from a still to the video: where the still has grey level i, the video has
/// levels[i]. The curve is applied to the luma of a still before the still is matched, so that the
/// still's detail has the contrast of the video.
struct StillTone {
    static constexpr int kLevels = 256;
    std::array<std::uint8_t, kLevels> levels = unchanged();

    [[nodiscard]] bool isIdentity() const { return *this == StillTone{}; }
    bool operator==(const StillTone&) const = default;
    /// True if the two curves differ so little that guidance learned with one of them also suits
    /// the other.
    [[nodiscard]] bool isNear(const StillTone& other) const {
        constexpr int kNear = 4;  // mean difference [grey levels]
        int sum = 0;
        for (std::size_t i = 0; i < kLevels; ++i)
            sum += std::abs(levels[i] - other.levels[i]);
        return sum <= kNear * kLevels;
    }
    void apply(std::span<std::uint8_t> row) const {
        for (std::uint8_t& level : row)
            level = levels[level];
    }

private:
    [[nodiscard]] static constexpr std::array<std::uint8_t, kLevels> unchanged() {
        std::array<std::uint8_t, kLevels> out{};
        for (std::size_t i = 0; i < kLevels; ++i)
            out[i] = static_cast<std::uint8_t>(i);
        return out;
    }
};

}  // namespace mfar
