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

/// Two-way errors of a row of cells, from its first cell on. If `errors` is null, they are computed
/// from the backward field.
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

/// A row of cells with their flow, and the results of lookUpCells() for them. The arrays extend to
/// a multiple of 16 cells; values beyond `count` are not used.
struct LookUpRow {
    int row, count;
    const float *flowX, *flowY;  ///< [video px]
    float *lookX, *lookY;        ///< LookUpCell::x and y [still px]
    float* confidence;           ///< eq. 2 of the paper with lambda(x) = min(x, 1); 0 if the flow
                                 ///< ends outside the still or the video
};

/// Computes where each cell's flow ends in the still, and its confidence, which tells how well the
/// flow and the backward field agree. CPU version of superres_assess.comp.
void lookUpCells(const LookUpParams& lookUp, const BackwardCells& backward, const LookUpRow& row);

}  // namespace mfar::simd
