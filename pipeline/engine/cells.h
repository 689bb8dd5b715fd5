#pragma once

#include <array>

namespace mfar {

// Fields with one entry per cell of 4x4 video pixels, as both engines store them: four floats per
// entry, which a GPU reads as one vec4.

/// A flow vector and the cost of its match.
struct FlowCell {
    float x = 0, y = 0;  ///< flow [px of the field's pyramid level]; p matches p + flow
    float cost = 0;      ///< 0: patches equal up to gain and offset; 1: unrelated; 2: negatives
    float texture = 0;   ///< sum of the squared deviations of the 8x8 patch around the cell from
                         ///< its mean [grey levels^2]
};

/// Two-way error of a cell (eq. 2 of the paper), determined by the search along epipolar lines.
struct ErrorCell {
    float error = 0;  ///< two-way error [px]
    float unused[3] = {};
};

/// How far the still is trusted at a cell.
struct WeighedCell {
    float x = 0, y = 0;    ///< flow [video px]
    float weight = 0;      ///< weight of the still's detail, [0, 2.31]
    float confidence = 0;  ///< eq. 2 of the paper, [0, 1]
};

/// Where output pixels in the cell read the still, and with which weight.
struct LookUpCell {
    float x = 0, y = 0;  ///< position in the still to which the flow leads, minus the cell's centre
                         ///< scaled to the still [still px]
    float weight = 0;    ///< see WeighedCell
    float confidence = 0;
};

/// Values of a cell, each in [0, 1], that determine the sharpening and the classes of tiles.
struct TrustCell {
    float halfWeight = 0;   ///< half of WeighedCell::weight
    float confidence = 0;   ///< eq. 2 of the paper
    float signal = 0;       ///< share of the video's variance that noise does not explain
    float unexplained = 0;  ///< 1: the cell is textured, but the still does not explain it; else 0
};

static_assert(sizeof(FlowCell) == 16 && sizeof(ErrorCell) == 16 && sizeof(WeighedCell) == 16 &&
              sizeof(LookUpCell) == 16 && sizeof(TrustCell) == 16);

}  // namespace mfar
