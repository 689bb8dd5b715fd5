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

/// Compares the patches of cells [first, last) in row `cellRow` of the video's cells with the
/// still, as patch.glsl does. A patch has 8x8 pixels around a cell of 4x4 pixels. In the still, the
/// patch is displaced by the cell's flow. The still is interpolated in steps of 2^-15 px and 1/64
/// grey level. Positions outside the still are clamped to its border; a flow that is NaN leads to
/// the left or upper border. The flow of up to 15 cells after `last` is read.
void comparePatches(const PatchLevel& video, const PatchLevel& still, int cellRow, int first,
                    int last, const float* flowX, const float* flowY, const PatchSums& out);

}  // namespace mfar::simd
