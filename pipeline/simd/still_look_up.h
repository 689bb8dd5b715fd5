#pragma once

#include "base/geometry.h"
#include "pipeline/engine/cells.h"

#include <array>
#include <cstddef>

namespace mfar::simd {

/// base/geometry.h's camera in single precision.
struct LensParams {
    explicit LensParams(const CameraModel& camera);
    float fx, fy, cx, cy;      ///< [px]
    float k1, k2, p1, p2, k3;  ///< distortion
    float width, height;       ///< [px]
    bool distorts;             ///< one of them is not zero
};

/// Two lenses, the rows of R_still_video and eq. 2's bound.
struct LookUpParams {
    explicit LookUpParams(const StereoRig& rig);
    LensParams video, still;
    std::array<std::array<float, 3>, 3> rotation;
    float alpha = 2;       ///< error without any confidence [video px]
    float scaleX, scaleY;  ///< still px per video px
};

/// Two-way errors: as a row that is known, or by the backward field.
struct BackwardCells {
    const ErrorCell* errors = nullptr;  ///< of the row's first cell; null: by the field
    const FlowCell* field = nullptr;
    std::ptrdiff_t pitch = 0;  ///< cells
    int columns = 0, rows = 0;
    float scale = 1;  ///< video px per pixel of the field's level
};

/// Splits a row of the flow into its two coordinates.
void splitFlow(const FlowCell* cells, int count, float* x, float* y);

/// Mean flow of 2x2 cells in pixels of the next coarser level. Reads 2 count cells.
void halveFlow(const float* upper, const float* lower, int count, float* out);

/// A row of cells of the flow and of what its ends are in the still. Its memory is a multiple of
/// 16 cells; what lies behind `count` is not used.
struct LookUpRow {
    int row, count;
    const float *flowX, *flowY;  ///< [video px]
    float *lookX, *lookY;        ///< end of the flow less the scaled cell centre [still px]
    float* confidence;           ///< eq. 2 with lambda(x) = min(x, 1); 0 outside of a picture
};

/// Where flow ends in the still and how well both fields agree (superres_assess.comp).
void lookUpCells(const LookUpParams& params, const BackwardCells& backward, const LookUpRow& row);

}  // namespace mfar::simd
