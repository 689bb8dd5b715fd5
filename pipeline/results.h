#pragma once

#include "hal/picture.h"
#include "pipeline/depth/depth_options.h"
#include "pipeline/engine/field.h"
#include "pipeline/plan/tiles.h"

#include <array>
#include <cstdint>

namespace mfar {

/// Statistics of one frame for the status line, the still policy and the summary. All are 0 before
/// the second frame.
struct FrameStats {
    std::array<int, kTileClasses> tiles{};  ///< number of tiles of each TileClass
    double meanConfidence = 0;              ///< mean confidence (eq. 2) over the frame, [0, 1]
    double explained = 0;  ///< share of tiles that are flat or explained by a still, [0, 1]
    /// Share of tiles whose video differs from the video from which they were last drawn.
    double changed = 0;
    bool usedStill = false;
    bool usedPose = false;     ///< matched along epipolar lines, because still and frame have poses
    bool predicted = false;    ///< the epipolar search started from the last frame's result
    bool refinedPose = false;  ///< the relative pose was refined from the pictures
    int posePatches = 0;       ///< number of patches that could be used to refine the pose; 0:
                               ///< epipolarError is 0
    double epipolarError = 0;  ///< median distance of the patches' matches from their epipolar
                               ///< lines [px]
    /// Number of tiles whose matches along epipolar lines were wrong, because an object moves or a
    /// pose is wrong. These tiles were searched in both dimensions instead. Without poses, all
    /// changed tiles are searched in both dimensions, and this number is 0.
    int searched2d = 0;
    /// matchedSecond: number of tiles matched with a second still because the newest does not show
    /// them. showSecond: number of tiles that show some of the second still, including neighbours
    /// of matched tiles.
    int matchedSecond = 0, showSecond = 0;
    /// Number of tiles in which real depth was measured, because a virtual object may be occluded
    /// there.
    int depthTiles = 0;
    /// Number of tiles under a virtual object in which real depth was not measured, because the
    /// real surface is known to lie behind the object.
    int depthTilesSkipped = 0;
    bool objectsInView = false;  ///< at least one virtual object is inside the picture
    bool objectsHidden = false;  ///< real things occlude all objects, so no object was drawn
    DepthSource depth = DepthSource::None;
    Transfers transfers{};  ///< between CPU memory and GPU, in this frame
};

/// Result of Pipeline::run(). It is valid until the next run.
struct FrameResult {
    Picture picture;         ///< in GPU memory or in CPU memory, wherever the engine drew it; alpha
                             ///< is 255
    bool unchanged = false;  ///< the picture is identical to the last run's
    FrameStats stats;
};

}  // namespace mfar
