#pragma once

#include "base/camera_lens.h"
#include "pipeline/engine/cells.h"
#include "pipeline/engine/params/weigh.h"

#include <array>
#include <cstddef>

namespace mfar::simd {

/// A lens and the size of the picture behind it.
struct LensParams : params::Lens {
    explicit LensParams(const CameraModel& camera);
    float width, height;  ///< [px]
    bool distorts;        ///< a coefficient of the distortion is not zero
};

/// Two lenses and the rows of R_still_video.
struct LookUpParams {
    explicit LookUpParams(const StereoRig& rig);
    LensParams video, still;
    std::array<params::Row3, 3> rotation;
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
void lookUpCells(const LookUpParams& lookUp, const BackwardCells& backward, const LookUpRow& row);

}  // namespace mfar::simd
