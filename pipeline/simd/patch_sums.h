#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// A level of a luma pyramid, from which patches are read. Rows repeat their border pixel 8 bytes
/// to the left and to the right; after that, 8 more bytes must be readable, with any values.
struct PatchLevel {
    const std::uint8_t* origin;  ///< address of pixel (0, 0)
    std::ptrdiff_t pitch;        ///< bytes from one row to the next
    int width, height;           ///< [px]
};

/// Covariance and variances of the patches of one row of cells. They are sums that are not divided
/// by the number of pixels [grey levels^2].
struct PatchSums {
    float* covariance;
    float* varianceVideo;  ///< null: not stored
    float* varianceStill;
};

/// Compares cells [first, last) of row `cellRow` of the video with the still, which is displaced by
/// the flow (patch.glsl). Patches of 8x8 pixels lie around cells of 4x4 pixels. The still is
/// interpolated in steps of 2^-15 px and 1/64 grey level. Positions outside are clamped to the
/// border; NaN flow points far to the left or above. Writes only these cells, but reads the flow of
/// up to 15 cells after them.
void comparePatches(const PatchLevel& video, const PatchLevel& still, int cellRow, int first,
                    int last, const float* flowX, const float* flowY, const PatchSums& out);

}  // namespace mfar::simd
