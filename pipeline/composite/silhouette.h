#pragma once

#include "pipeline/composite/object_projection.h"
#include "pipeline/composite/scene_boxes.h"

#include <span>
#include <vector>

namespace mfar {

/// Range of z [m] of the virtual surfaces in and around a tile; both 0: there are none.
struct SurfaceRange {
    float nearest = 0, farthest = 0;
};

/// Finds on the host the tiles of the video picture where virtual objects are: only there real
/// depth is needed, and only where it can be less than the farthest surface. Conservative: ranges
/// may be too wide and there may be too many tiles, never the opposite. Allocates only in its
/// constructor.
class Silhouette {
public:
    /// `margin`: a tile includes every surface within this distance of its pixels [video px].
    Silhouette(const CameraModel& video, int margin);

    /// Row-major, ceil(video / kTileSize) tiles. Valid until the next run.
    const std::vector<SurfaceRange>& run(std::span<const VirtualObject> objects,
                                         const RigidTransform& T_world_video);

    /// As above, for a scene.
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
