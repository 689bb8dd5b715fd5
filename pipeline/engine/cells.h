#pragma once

#include <array>

namespace mfar {

// Fields with one entry per cell of 4x4 video pixels, as both engines store them: four floats per
// entry, which a GPU reads as one vec4.

/// A flow vector and how well it matches.
struct FlowCell {
    float x = 0, y = 0;  ///< [px of the field's pyramid level]; p matches p + (x, y)
    float cost = 0;      ///< 0: equal up to gain and offset, 1: unrelated, 2: inverted
    float texture = 0;   ///< energy of the 8x8 patch around the cell [grey levels^2]
};

/// Two-way error of a cell (eq. 2 of the paper), determined by the search along epipolar lines.
struct ErrorCell {
    float error = 0;  ///< [px]
    float unused[3] = {};
};

/// Trust in the still at a cell.
struct WeighedCell {
    float x = 0, y = 0;    ///< flow [video px]
    float weight = 0;      ///< of the still's detail, [0, 2.31]
    float confidence = 0;  ///< eq. 2 of the paper, [0, 1]
};

/// Offset and weight with which output pixels in the cell read the still.
struct LookUpCell {
    float x = 0, y = 0;  ///< end of the flow in the still minus the scaled cell centre [still px]
    float weight = 0;    ///< see WeighedCell
    float confidence = 0;
};

/// Inputs of sharpening and of tile classes, per cell, each in [0, 1].
struct TrustCell {
    float halfWeight = 0;   ///< half of WeighedCell::weight
    float confidence = 0;   ///< eq. 2 of the paper
    float signal = 0;       ///< share of the video's variance that noise does not explain
    float unexplained = 0;  ///< 1: textured, but the still does not show it
};

static_assert(sizeof(FlowCell) == 16 && sizeof(ErrorCell) == 16 && sizeof(WeighedCell) == 16 &&
              sizeof(LookUpCell) == 16 && sizeof(TrustCell) == 16);

}  // namespace mfar
