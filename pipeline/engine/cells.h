#pragma once

#include <array>

namespace mfar {

// Entries of arrays with one entry per cell, as both engines store them. A GPU reads the four
// floats of an entry as one vec4. `confidence` is eq. 2 of the paper (docs/paper.md), in [0, 1].

struct FlowCell {
    /// The flow: pixel p is seen at p + (x, y) in the other picture [px of the pyramid level].
    float x = 0, y = 0;
    /// 0: patches equal up to gain and offset; 1: unrelated patches; 2: one is the other's
    /// negative.
    float cost = 0;
    /// Sum of the squared deviations from the mean in the 8x8 patch around the cell [grey
    /// levels^2].
    float texture = 0;
};

/// Two-way error of a cell's flow [px] (eq. 2 of the paper), determined by the epipolar search.
struct ErrorCell {
    float error = 0;
    // Sums over the cell's patch in the video and in the still itself; see params::kPatchSamples.
    // 0: not compared with the still itself.
    float covariance = 0, varianceVideo = 0, varianceStill = 0;
};

struct WeighedCell {
    float x = 0, y = 0;  ///< flow [video px]
    /// Weight of the still's detail, [0, 2.31]: at most params::kLargestGain * params::kLookUpLoss,
    /// but it can be rounded up.
    float weight = 0;
    float confidence = 0;
};

/// Offset and weight with which the output pixels of a cell read the still.
struct LookUpCell {
    /// Position in the still at which the cell's flow vector ends, minus the cell's centre times
    /// (still pixels per video pixel) [still px].
    float x = 0, y = 0;
    float weight = 0;
    float confidence = 0;
};

/// Values in [0, 1] that determine the strength of the sharpening and the classes of tiles.
struct TrustCell {
    float halfWeight = 0;
    float confidence = 0;
    float signal = 0;       ///< share of the video's variance that is not noise
    float unexplained = 0;  ///< 1 for a textured cell without a reliable match, else 0
};

static_assert(sizeof(FlowCell) == 16 && sizeof(ErrorCell) == 16 && sizeof(WeighedCell) == 16 &&
              sizeof(LookUpCell) == 16 && sizeof(TrustCell) == 16);

}  // namespace mfar
