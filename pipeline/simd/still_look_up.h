#pragma once

#include "base/camera_lens.h"
#include "pipeline/engine/cells.h"
#include "pipeline/engine/params/weigh.h"

#include <array>
#include <cstddef>

namespace mfar::simd {

/// A lens and the size of its picture.
struct LensParams : params::Lens {
    explicit LensParams(const CameraModel& camera);
    float width, height;  ///< [px]
    bool distorts;        ///< whether a distortion coefficient is not zero
};

/// Two lenses and the rows of R_still_video.
struct LookUpParams {
    explicit LookUpParams(const StereoRig& rig);
    LensParams video, still;
    std::array<params::Row3, 3> rotation;
    float scaleX, scaleY;  ///< still px per video px
};

/// Two-way errors: a row of known errors, or the backward field to compute them from.
struct BackwardCells {
    const ErrorCell* errors = nullptr;  ///< for the row's first cell; null: use the field
    const FlowCell* field = nullptr;
    std::ptrdiff_t pitch = 0;  ///< cells
    int columns = 0, rows = 0;
    float scale = 1;  ///< video px per pixel of the field's level
};

/// Splits a row of the flow into its two coordinates.
void splitFlow(const FlowCell* cells, int count, float* x, float* y);

/// Mean flow of 2x2 cells, in pixels of the next coarser level. Reads 2 * count cells.
void halveFlow(const float* upper, const float* lower, int count, float* out);

/// A row of cells of the flow, and the results for where it ends in the still. The memory extends
/// to a multiple of 16 cells; values beyond `count` are not used.
struct LookUpRow {
    int row, count;
    const float *flowX, *flowY;  ///< [video px]
    float *lookX, *lookY;        ///< end of the flow less the scaled cell centre [still px]
    float* confidence;           ///< eq. 2 with lambda(x) = min(x, 1); 0 outside the still or the
                                 ///< video
};

/// Computes where flow ends in the still and how well both fields agree (superres_assess.comp).
void lookUpCells(const LookUpParams& lookUp, const BackwardCells& backward, const LookUpRow& row);

}  // namespace mfar::simd
