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
    bool distorts;        ///< true if any coefficient of the distortion is not zero
};

/// Two lenses, and the rows of R_still_video.
struct LookUpParams {
    explicit LookUpParams(const StereoRig& rig);
    LensParams video, still;
    std::array<params::Row3, 3> rotation;
    float scaleX, scaleY;  ///< still pixels per video pixel
};

/// Two-way errors: either a row of known errors, or the backward field from which they are
/// computed.
struct BackwardCells {
    const ErrorCell* errors = nullptr;  ///< of the row's first cell; null: use the backward field
    const FlowCell* field = nullptr;
    std::ptrdiff_t pitch = 0;  ///< cells from one row to the next
    int columns = 0, rows = 0;
    float scale = 1;  ///< video pixels per pixel of the field's level
};

/// Splits a row of the flow into its two components.
void splitFlow(const FlowCell* cells, int count, float* x, float* y);

/// Computes the mean flow of 2x2 cells, in pixels of the next coarser level. Reads 2 * count cells.
void halveFlow(const float* upper, const float* lower, int count, float* out);

/// A row of cells with their flow, and results for where the flow ends in the still. The memory
/// extends to a multiple of 16 cells; values beyond `count` are not used.
struct LookUpRow {
    int row, count;
    const float *flowX, *flowY;  ///< [video px]
    float *lookX, *lookY;        ///< end of the flow minus the scaled cell centre [still px]
    float* confidence;           ///< eq. 2 of the paper with lambda(x) = min(x, 1); 0 if the flow
                                 ///< ends outside the still or the video
};

/// Computes where the flow ends in the still, and how well both fields agree
/// (superres_assess.comp).
void lookUpCells(const LookUpParams& lookUp, const BackwardCells& backward, const LookUpRow& row);

}  // namespace mfar::simd
