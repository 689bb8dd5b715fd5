#pragma once

#include "base/rows.h"
#include "pipeline/slices/hole_request.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace mfar::simd {

/// While the camera rests, replaces blurred pixels of ViewLookUp's picture by rendered ones. CPU
/// version of the GLES engine's EdgeRefiner.
class EdgeSharpener {
public:
    static constexpr int kLevels = 64;

    /// `share`, `fadeFrames`: see WarpOptions. `most`: largest number of listed pixels; exceeded
    /// only if more pixels have the highest contrast level.
    EdgeSharpener(Size layer, double share, int most, int fadeFrames);

    /// Lists the pixels with the highest contrast within `where`, given the `colour` and `state` of
    /// ViewLookUp. Discards the previous list and its rendered colours.
    void list(Rows<const std::uint32_t> colour, Rows<const std::uint32_t> state,
              const PixelRect& where);
    /// Returns the row-major indices of the listed pixels, ascending. Returns nothing if the list
    /// was already taken.
    std::optional<std::vector<std::uint32_t>> take();
    /// Stores the rendered colours of pixels that take() returned; ignores other pixels.
    void answer(const HoleAnswer& answer);
    /// Blends the rendered colours into `colour`, which must show the same view as the listed
    /// picture. Their weight rises from frame to frame.
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
    std::vector<std::array<std::uint32_t, 2>>
        listed_;  // index and colour of each listed pixel, ascending
    std::vector<Entry> entries_;
    double shown_ = 0;  // weight of the rendered colours; 0: there are none
};

}  // namespace mfar::simd
