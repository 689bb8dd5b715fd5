#pragma once

#include "base/image_view.h"
#include "base/rows.h"
#include "pipeline/simd/still_kernels.h"

#include <array>

namespace mfar::simd {

/// Computes the Rec. 601 luma of a valid picture's RGB colours, row by row, for any pixel format.
class StillLuma {
public:
    struct Scratch {
        explicit Scratch(int width) : half({width / 2 + 2, 1}), chroma({width, 1}) {}
        AlignedRows<float> half;
        AlignedRows<std::int16_t> chroma;
    };

    explicit StillLuma(const ImageView& picture);

    /// Writes the luma of row y, and up to 64 bytes beyond its end.
    void row(int y, Scratch& scratch, std::uint8_t* luma) const;

private:
    /// Samples of U or V, which are step_ bytes apart.
    struct Samples {
        const std::uint8_t* data = nullptr;
        std::size_t stride = 0;
        float gain = 0;
    };
    [[nodiscard]] const std::int16_t* chromaRow(int y, Scratch& scratch) const;

    ImageView picture_;
    LumaGain gain_{1 << 14, 0};
    std::array<Samples, 2> chroma_;
    int step_ = 1;
    bool needsChroma_ = false;
};

}  // namespace mfar::simd
