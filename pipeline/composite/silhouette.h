#pragma once

#include "pipeline/composite/object_projection.h"
#include "pipeline/composite/scene_boxes.h"

#include <span>
#include <vector>

namespace mfar {

/// Smallest and largest z [m] of the virtual surfaces in and around a tile; both 0: there is no
/// surface.
struct SurfaceRange {
    float nearest = 0, farthest = 0;
};

/// Finds the tiles of the video that contain virtual objects, and the range of their z, on the CPU.
/// Real depth is needed only in these tiles, and only if the real surface may be nearer than the
/// farthest virtual surface. The result is conservative: there may be too many tiles, and ranges
/// may be too wide, but never too few tiles or too narrow ranges. Allocates only in its
/// constructor.
class Silhouette {
public:
    /// `margin`: the range of a tile includes every surface within this distance of its pixels
    /// [video px].
    Silhouette(const CameraModel& video, int margin);

    /// Returns the ranges of ceil(video / kTileSize) tiles, row-major. Valid until the next run.
    const std::vector<SurfaceRange>& run(std::span<const VirtualObject> objects,
                                         const RigidTransform& T_world_video);

    /// Like the other run(), but for the objects of a path-traced scene or for a shadow catcher.
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
