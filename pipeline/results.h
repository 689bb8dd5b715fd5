#pragma once

#include "hal/picture.h"
#include "pipeline/depth/depth_options.h"
#include "pipeline/engine/field.h"
#include "pipeline/plan/tiles.h"

#include <array>
#include <cstdint>

namespace mfar {

/// Statistics of one frame for the status line, the still policy and the summary.
struct FrameStats {
    // With the GLES engine, the GPU counts these numbers, and they are those of the frame before.
    // In the first frame, they are 0.
    std::array<int, kTileClasses> tiles{};  ///< number of tiles of each TileClass
    double meanConfidence = 0;              ///< mean of the confidence (eq. 2 of the paper), [0, 1]
    /// Share of tiles that are flat or match a still, [0, 1]. If Quality::detailShare leaves out
    /// some tiles with structure, they are assumed to match as often as the others. 0 without a
    /// still.
    double explained = 0;
    /// showSecond: number of tiles that show some of the second still. It includes neighbours of
    /// the tiles in matchedSecond. searched2d: number of tiles whose match along epipolar lines was
    /// wrong, because an object moves or a pose is wrong. These tiles were then searched in both
    /// dimensions. Without poses, all changed and matched tiles are searched in both dimensions,
    /// and this number is 0.
    int showSecond = 0, searched2d = 0;

    // These numbers are those of the frame itself.
    double changed = 0;  ///< share of tiles whose video changed since they were last drawn, [0, 1]
    double redrawn = 0;  ///< share of tiles that were drawn again for any reason, [0, 1]
    bool usedStill = false;
    /// True if changed parts were matched along epipolar lines, see Pipeline::setStill().
    bool usedPose = false;
    bool predicted = false;
    bool refinedPose = false;
    /// posePatches: number of patches that were matched to refine the pose. epipolarError: the
    /// median of their distances from their epipolar lines [px], or 0 without patches.
    int posePatches = 0;
    double epipolarError = 0;
    /// Number of tiles that were matched with the second still, because the newest still does not
    /// show them.
    int matchedSecond = 0;
    /// Number of tiles that need real depth, because a virtual object may be occluded there. Tiles
    /// that get the depth of an earlier frame count, too (see Quality::depthEvery).
    int depthTiles = 0;
    /// Number of tiles of Pipeline::objectsRegion() that need no real depth, because the real
    /// surface is known to lie behind the objects.
    int depthTilesSkipped = 0;
    bool objectsInView = false;
    bool objectsHidden = false;  ///< nothing virtual was drawn, because real things hide it
    DepthSource depth = DepthSource::None;
    Transfers transfers{};
};

struct FrameResult {
    Picture picture;  ///< in the memory of the engine that drew it; alpha is 255
    bool unchanged = false;
    FrameStats stats;
};

}  // namespace mfar
