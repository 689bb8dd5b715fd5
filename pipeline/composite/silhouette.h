#pragma once

#include "pipeline/composite/object_projection.h"
#include "pipeline/composite/scene_boxes.h"

#include <span>
#include <vector>

namespace mfar {

/// Smallest and largest z [m] of the virtual surfaces in and around a tile. Both are 0 if there is
/// no virtual surface.
struct SurfaceRange {
    float nearest = 0, farthest = 0;
};

/// Finds on the CPU the tiles of the video that contain virtual objects, and the range of the
/// objects' z in each tile. The result can contain too many tiles and too wide ranges, but never
/// too few tiles or too narrow ranges. Only the constructor allocates memory.
class Silhouette {
public:
    /// The range of a tile includes all surfaces within `margin` [video px] of its pixels.
    Silhouette(const CameraModel& video, int margin);

    /// Returns the ranges of all tiles, row-major. They are valid until the next run.
    const std::vector<SurfaceRange>& run(std::span<const VirtualObject> objects,
                                         const RigidTransform& T_world_video);

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
