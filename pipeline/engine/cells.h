#pragma once

#include "pipeline/engine/params/weigh.h"

#include <cmath>

namespace mfar {

// The structs of this file are entries of arrays that have one entry per cell. Both engines use
// them. A GPU reads the four floats of an entry as one vec4. `confidence` is eq. 2 of the paper
// (docs/paper.md), in [0, 1].

struct FlowCell {
    /// The flow: pixel p is seen at p + (x, y) in the other picture [px of the pyramid level].
    float x = 0, y = 0;
    /// Difference of the two patches. 0: equal up to gain and offset. 1: unrelated. 2: one is the
    /// other's negative.
    float cost = 0;
    /// Sum of the squared deviations from the mean in the 8x8 patch around the cell [grey
    /// levels^2].
    float texture = 0;
};

/// Result of the epipolar search for a cell. `error` is the two-way error [px], see eq. 2 of the
/// paper (docs/paper.md).
struct ErrorCell {
    float error = 0;
    // Sums over the cell's patch from a comparison of the video with the still at its full
    // resolution, see params::kPatchSamples. They are 0 if the cell was not compared in this way,
    // or if the correlation was not larger than in the pyramids (1 - FlowCell::cost).
    float covariance = 0, varianceVideo = 0, varianceStill = 0;
};

struct WeighedCell {
    float x = 0, y = 0;  ///< flow [video px]
    /// Weight of the still's detail, in [0, 2.31]. The limit is params::kLargestGain *
    /// params::kLookUpLoss = 2.3, and rounding can exceed it slightly.
    float weight = 0;
    float confidence = 0;
};

/// Offset and weight with which the output pixels of a cell read the still.
struct LookUpCell {
    /// Offset [still px]. The point p [video px] of a cell is seen in the still at p * (still
    /// pixels per video pixel) + (x, y). (Pixel coordinates here start at the picture's corner.)
    float x = 0, y = 0;
    float weight = 0;
    float confidenceAndJumps = 0;  ///< see params::kJumpRight

    [[nodiscard]] float confidence() const {
        return confidenceAndJumps -
               params::kJumpRight * std::floor(confidenceAndJumps / params::kJumpRight);
    }
    [[nodiscard]] bool jumpsBelow() const { return confidenceAndJumps >= params::kJumpBelow; }
    [[nodiscard]] bool jumpsRight() const {
        return confidenceAndJumps - (jumpsBelow() ? params::kJumpBelow : 0) >= params::kJumpRight;
    }
};

/// Four values in [0, 1]. They determine how much a tile is sharpened, and its class.
struct TrustCell {
    float halfWeight = 0;  ///< half of the weight of the still's detail, at most 1
    float confidence = 0;
    float signal = 0;       ///< share of the video's variance that is not noise
    float unexplained = 0;  ///< 1 for a textured cell without a reliable match, else 0
};

static_assert(sizeof(FlowCell) == 16 && sizeof(ErrorCell) == 16 && sizeof(WeighedCell) == 16 &&
              sizeof(LookUpCell) == 16 && sizeof(TrustCell) == 16);

}  // namespace mfar
