#pragma once

#include <array>

namespace mfar {

// Fields of one entry per cell of 4x4 video pixels, as both engines store them: four floats each,
// so that a GPU reads an entry as one vec4.

/// A flow vector and how well it matches.
struct FlowCell {
    float x = 0, y = 0;  ///< [px of the field's pyramid level]; p looks like p + (x, y)
    float cost = 0;      ///< 0: alike up to gain and offset, 1: unrelated, 2: inverted
    float texture = 0;   ///< energy of the 8x8 patch around the cell [grey levels^2]
};

/// Known two-way error of a cell (eq. 2), where a search along lines has found it.
struct ErrorCell {
    float error = 0;  ///< [px]
    float unused[3] = {};
};

/// How far the still is trusted at a cell.
struct WeighedCell {
    float x = 0, y = 0;    ///< flow [video px]
    float weight = 0;      ///< of the still's detail, [0, 2.31]
    float confidence = 0;  ///< eq. 2, [0, 1]
};

/// Where an output pixel at the cell looks into the still.
struct LookUpCell {
    float x = 0, y = 0;  ///< end of the flow less the scaled cell centre [still px]
    float weight = 0;    ///< as WeighedCell
    float confidence = 0;
};

/// What sharpening and tile classes need to know of a cell, each in [0, 1].
struct TrustCell {
    float halfWeight = 0;   ///< half of the weight
    float confidence = 0;   ///< eq. 2
    float signal = 0;       ///< share of the video's variance that noise does not explain
    float unexplained = 0;  ///< 1: textured, but the still does not show it
};

static_assert(sizeof(FlowCell) == 16 && sizeof(ErrorCell) == 16 && sizeof(WeighedCell) == 16 &&
              sizeof(LookUpCell) == 16 && sizeof(TrustCell) == 16);

}  // namespace mfar
