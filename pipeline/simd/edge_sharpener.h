#pragma once

#include "base/rows.h"
#include "pipeline/slices/hole_request.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace mfar::simd {

/// Replaces pixels that the look-up blurs, while the camera rests: EdgeRefiner on the CPU.
class EdgeSharpener {
public:
    static constexpr int kLevels = 64;  ///< of contrast

    /// See WarpOptions. `most`: upper limit of listed pixels, unless more have the highest contrast
    /// level.
    EdgeSharpener(Size layer, double share, int most, int fadeFrames);

    /// Lists the pixels of highest contrast within `where`, from a look-up's `colour` and `state`.
    /// Discards the previous list and answer.
    void list(Rows<const std::uint32_t> colour, Rows<const std::uint32_t> state,
              const PixelRect& where);
    /// The listed pixels: row-major indices, ascending. Returned once.
    std::optional<std::vector<std::uint32_t>> take();
    /// Takes the answer for pixels returned by take(); other pixels are ignored.
    void answer(const HoleAnswer& answer);
    /// Blends the answered pixels into a `colour` of the same pose, with a weight that rises from
    /// frame to frame.
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
    double shown_ = 0;  // weight of the answer, 0: no answer
};

}  // namespace mfar::simd
