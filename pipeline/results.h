#pragma once

#include "hal/picture.h"
#include "pipeline/depth/depth_options.h"
#include "pipeline/engine/field.h"
#include "pipeline/plan/tiles.h"

#include <array>
#include <cstdint>

namespace mfar {

/// Numbers of one frame for status, trigger and summary. Zero before the second frame.
struct FrameStats {
    std::array<int, kTileClasses> tiles{};  ///< count per TileClass
    double meanConfidence = 0;              ///< of eq. 2 over the frame, [0, 1]
    double explained = 0;  ///< share of tiles that are flat or that a still accounts for, [0, 1]
    double changed = 0;    ///< share of tiles whose video differs from when they were last drawn
    bool usedStill = false;
    bool usedPose = false;     ///< matched along epipolar lines, as the poses of both were known
    bool predicted = false;    ///< searched around what the frame before showed
    bool refinedPose = false;  ///< the pictures said more of the relative pose than both poses
    int posePatches = 0;       ///< patches that were there to tell; below, zero without any
    double epipolarError = 0;  ///< their median distance from the lines that were searched [px]
    /// Tiles that those lines did not explain (something moves there, or a pose is wrong), which
    /// were searched in both dimensions. Without poses all changed tiles are, and none counted.
    int searched2d = 0;
    /// Tiles that the newest still does not show and that were matched with a second one; those of
    /// them and beside them that show some of it.
    int matchedSecond = 0, showSecond = 0;
    /// Tiles in which real depth was measured, as a virtual object may be hidden there.
    int depthTiles = 0;
    /// Tiles under a virtual object in which real depth was not measured, as it is known to lie
    /// behind that.
    int depthTilesSkipped = 0;
    bool objectsInView = false;  ///< a virtual object is within the picture's borders
    bool objectsHidden = false;  ///< and real things are before all of them: nothing was drawn
    DepthSource depth = DepthSource::None;
    Transfers transfers{};  ///< between host and GPU, in this frame
};

/// What Pipeline::run gives back. Valid until the next run.
struct FrameResult {
    Picture picture;         ///< where the engine left it, alpha 255
    bool unchanged = false;  ///< the image is that of the run before, to the bit
    FrameStats stats;
};

}  // namespace mfar
