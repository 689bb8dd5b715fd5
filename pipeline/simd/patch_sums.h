#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// A luma level for reading patches: rows repeat their border pixel 8 bytes to the left and to the
/// right; 8 more bytes of any value must be readable after those.
struct PatchLevel {
    const std::uint8_t* origin;  ///< pixel (0, 0)
    std::ptrdiff_t pitch;        ///< bytes from one row to the next
    int width, height;           ///< [px]
};

/// One row of results, an entry per cell, not divided by the number of pixels [grey levels^2].
struct PatchSums {
    float* covariance;
    float* varianceVideo;  ///< may be null
    float* varianceStill;
};

/// Compares cells [first, last) of row `cellRow` of the video with the still displaced by the flow
/// (patch.glsl): patches of 8x8 pixels around cells of 4x4; the still is interpolated in steps of
/// 2^-15 px and 1/64 grey level. Positions outside are clamped to the border; NaN counts as far to
/// the left or above. Writes only those cells; reads the flow of up to 15 cells after them.
void comparePatches(const PatchLevel& video, const PatchLevel& still, int cellRow, int first,
                    int last, const float* flowX, const float* flowY, const PatchSums& out);

}  // namespace mfar::simd
