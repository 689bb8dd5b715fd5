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
    static constexpr int kLevels = 64;  ///< number of contrast levels

    /// `share`: see WarpOptions::sharpenShare. `most`: largest number of listed pixels. All pixels
    /// of the contrast level kLevels - 1 are listed, even if these two limits allow fewer.
    EdgeSharpener(Size layer, double share, int most, int fadeFrames);

    /// Lists the pixels with the highest contrast within `where`. `colour`, `state`: pictures of
    /// ViewLookUp. The previous list and its rendered colours are discarded.
    void list(Rows<const std::uint32_t> colour, Rows<const std::uint32_t> state,
              const PixelRect& where);
    /// Returns the row-major indices of the listed pixels, ascending. Returns nullopt if there is
    /// no list or take() has already returned it.
    std::optional<std::vector<std::uint32_t>> take();
    /// Stores the rendered colours of the pixels that take() returned, but of no more than `most`
    /// pixels. Ignores other pixels.
    void answer(const HoleAnswer& answer);
    /// Blends the rendered colours into `colour`, which must show the same view as the picture
    /// given to list(). The weight of the rendered colours rises to 1 within `fadeFrames` calls.
    void show(Rows<std::uint32_t> colour);
    /// Discards the list and its rendered colours.
    void drop();

private:
    struct Entry {
        std::uint32_t pixel, before, rendered;
    };

    Size layer_;
    double share_, step_;
    std::size_t most_;
    bool isListed_ = false;
    // Index and colour of each listed pixel, in ascending order of the indices.
    std::vector<std::array<std::uint32_t, 2>> listed_;
    std::vector<Entry> entries_;
    double shown_ = 0;  // weight of the rendered colours; 0 if there are none
};

}  // namespace mfar::simd
