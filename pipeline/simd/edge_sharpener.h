#pragma once

#include "base/rows.h"
#include "pipeline/slices/hole_request.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace mfar::simd {

/// Replaces what a look-up blurs while the camera rests: EdgeRefiner on the host.
class EdgeSharpener {
public:
    static constexpr int kLevels = 64;  ///< of contrast

    /// See WarpOptions. Lists `most` pixels at most, unless more have the very highest contrast.
    EdgeSharpener(Size layer, double share, int most, int fadeFrames);

    /// Lists the pixels with the most contrast of a look-up's `colour` and `state` within `where`.
    /// Forgets the list and the answer before.
    void list(Rows<const std::uint32_t> colour, Rows<const std::uint32_t> state,
              const PixelRect& where);
    /// Row-major indices, ascending, once.
    std::optional<std::vector<std::uint32_t>> take();
    /// To pixels that take() gave; others are left out.
    void answer(const HoleAnswer& answer);
    /// Replaces the pixels, a little more with each frame, in a `colour` of the same pose.
    void show(Rows<std::uint32_t> colour);
    void drop();

private:
    struct Entry {
        std::uint32_t pixel, before, rendered;
    };

    Size layer_;
    double share_, step_;
    std::size_t most_;
    bool isListed_ = false;
    std::vector<std::array<std::uint32_t, 2>> listed_;  // pixel, colour; ascending
    std::vector<Entry> entries_;
    double shown_ = 0;  // share of the answer, 0: there is none
};

}  // namespace mfar::simd
