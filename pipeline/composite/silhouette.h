#pragma once

#include "pipeline/composite/object_projection.h"
#include "pipeline/composite/scene_boxes.h"

#include <span>
#include <vector>

namespace mfar {

/// Range of z [m] of the virtual surfaces in and around a tile; both 0: no surface.
struct SurfaceRange {
    float nearest = 0, farthest = 0;
};

/// Finds the tiles of the video picture that contain virtual objects, on the CPU. Real depth is
/// needed only in these tiles, and only where it can be less than the depth of the farthest virtual
/// surface. The result is conservative: a range may be too wide and there may be too many tiles,
/// never the opposite. Allocates only in its constructor.
class Silhouette {
public:
    /// `margin`: a tile includes every surface within this distance of its pixels [video px].
    Silhouette(const CameraModel& video, int margin);

    /// Returns the ranges of ceil(video / kTileSize) tiles, row-major. Valid until the next run.
    const std::vector<SurfaceRange>& run(std::span<const VirtualObject> objects,
                                         const RigidTransform& T_world_video);

    /// As above, but for a path-traced scene.
    const std::vector<SurfaceRange>& run(SceneBoxes& scene, const RigidTransform& T_world_video);

    [[nodiscard]] Size tileCount() const { return tileCount_; }

private:
    void add(const SurfaceExtent& extent);

    ObjectProjection projection_;
    double margin_;
    Size tileCount_;
    std::vector<SurfaceRange> tiles_;
};

}  // namespace mfar
