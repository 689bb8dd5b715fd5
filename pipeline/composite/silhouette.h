#pragma once

#include "pipeline/composite/object_projection.h"
#include "pipeline/composite/scene_boxes.h"

#include <span>
#include <vector>

namespace mfar {

/// z [m] of the virtual surfaces in and around a tile; both 0: there are none.
struct SurfaceRange {
    float nearest = 0, farthest = 0;
};

/// Where virtual objects are in the video picture, tile by tile, on the host: real depth is needed
/// only there, and only where it can be less than the farthest surface. Conservative: a range may
/// be too wide and a tile too many, never the other way. Allocates in its constructor alone.
class Silhouette {
public:
    /// `margin` [video px]: a tile counts every surface within this distance of its pixels.
    Silhouette(const CameraModel& video, int margin);

    /// Row-major, ceil(video / kTileSize) tiles. Valid until the next run.
    const std::vector<SurfaceRange>& run(std::span<const VirtualObject> objects,
                                         const RigidTransform& T_world_video);

    /// The same of a scene.
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
