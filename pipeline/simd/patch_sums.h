#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// A level of a luma pyramid, from which patches are read. Each row is extended by 8 copies of its
/// border pixel on the left and on the right. After the copies on the right, 8 more bytes must be
/// readable, with any values.
struct PatchLevel {
    const std::uint8_t* origin;
    std::ptrdiff_t pitch;
    int width, height;
};

/// Covariances and variances of the patches of one row of cells, as sums over the 64 pixels [grey
/// levels^2].
struct PatchSums {
    float* covariance;
    float* varianceVideo;  ///< null: not stored
    float* varianceStill;
};

/// Compares the patches of cells [first, last) in the video's row `cellRow` with the still at the
/// ends of their flow vectors (patch.glsl). A patch has 8x8 pixels around a cell of 4x4 pixels. The
/// still is interpolated in steps of 2^-15 px and 1/64 grey level. Positions outside the still are
/// clamped to its border; a NaN counts as far to the left or far above. The flow of up to 15 cells
/// after `last` is read.
void comparePatches(const PatchLevel& video, const PatchLevel& still, int cellRow, int first,
                    int last, const float* flowX, const float* flowY, const PatchSums& out);

}  // namespace mfar::simd
