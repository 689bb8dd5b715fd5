#pragma once

#include "base/camera_lens.h"
#include "pipeline/engine/cells.h"
#include "pipeline/engine/params/weigh.h"

#include <array>
#include <cstddef>

namespace mfar::simd {

struct LensParams : params::Lens {
    explicit LensParams(const CameraModel& camera);
    float width, height;
    bool distorts;
};

struct LookUpParams {
    explicit LookUpParams(const StereoRig& rig);
    LensParams video, still;
    std::array<params::Row3, 3> rotation;
    float scaleX, scaleY;  ///< still pixels per video pixel
};

/// The source from which lookUpCells() gets the two-way errors of a row of cells. If `errors` is
/// not null, it contains the errors, from the row's first cell on. Otherwise they are computed from
/// `field`, the flow from still to video.
struct BackwardCells {
    const ErrorCell* errors = nullptr;
    const FlowCell* field = nullptr;
    std::ptrdiff_t pitch = 0;
    int columns = 0, rows = 0;
    float scale = 1;  ///< video pixels per pixel of the pyramid level that `field` belongs to
};

void splitFlow(const FlowCell* cells, int count, float* x, float* y);

/// Computes the mean flow of blocks of 2x2 cells, in pixels of the next coarser pyramid level.
/// Reads 2 * count cells of each row.
void halveFlow(const float* upper, const float* lower, int count, float* out);

/// A row of cells with their flow, and the results of lookUpCells() for them. The arrays' length is
/// `count`, rounded up to a multiple of 16; values after `count` have no meaning.
struct LookUpRow {
    int row, count;
    const float *flowX, *flowY;  ///< [video px]
    float *lookX, *lookY;        ///< LookUpCell::x and y [still px]
    /// Confidence, as in eq. 2 of the paper with lambda(x) = min(x, 1), see docs/paper.md. It is 0
    /// if the flow ends outside the still or outside the video.
    float* confidence;
};

/// Computes the position in the still at which each cell's flow vector ends, and the cell's
/// confidence. The confidence is high if the backward field leads back to the cell. CPU version of
/// superres_assess.comp.
void lookUpCells(const LookUpParams& lookUp, const BackwardCells& backward, const LookUpRow& row);

}  // namespace mfar::simd
