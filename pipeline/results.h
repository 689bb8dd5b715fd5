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
    double meanConfidence = 0;              ///< mean of eq. 2 over the frame, [0, 1]
    double explained = 0;  ///< share of tiles that are flat or explained by a still, [0, 1]
    /// Share of tiles whose video differs from the video they were last drawn from.
    double changed = 0;
    bool usedStill = false;
    bool usedPose = false;     ///< matched along epipolar lines, because both poses were known
    bool predicted = false;    ///< search started from the last frame's result
    bool refinedPose = false;  ///< the pictures gave a better relative pose than the two poses
    int posePatches = 0;       ///< patches available for that; without any, the following are zero
    double epipolarError = 0;  ///< the patches' median distance from the searched lines [px]
    /// Tiles that the epipolar lines did not explain (a moving object, or a wrong pose) and that
    /// were therefore searched in both dimensions. Without poses all changed tiles are searched so,
    /// and 0 is reported.
    int searched2d = 0;
    /// Tiles matched with a second still because the newest does not show them; and those of them
    /// and next to them that show some of the second still.
    int matchedSecond = 0, showSecond = 0;
    /// Tiles in which real depth was measured, because a virtual object may be occluded there.
    int depthTiles = 0;
    /// Tiles under a virtual object in which real depth was not measured, because the surface is
    /// known to lie behind the object.
    int depthTilesSkipped = 0;
    bool objectsInView = false;  ///< a virtual object is within the picture's borders
    bool objectsHidden = false;  ///< all of them are occluded by real things: nothing was drawn
    DepthSource depth = DepthSource::None;
    Transfers transfers{};  ///< between host and GPU, in this frame
};

/// Result of Pipeline::run. Valid until the next run.
struct FrameResult {
    Picture picture;         ///< stored where the engine left it, alpha 255
    bool unchanged = false;  ///< the picture is identical to that of the last run
    FrameStats stats;
};

}  // namespace mfar
