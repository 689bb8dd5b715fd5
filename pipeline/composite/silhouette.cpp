#include "pipeline/composite/silhouette.h"

#include "pipeline/results.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

// Length added to the margin [px]. It allows for the size of a pixel, and for the distance of
// straight triangle edges from the curved outlines of a sphere or of a picture with lens
// distortion.
constexpr double kSlack = 1;

}  // namespace

Silhouette::Silhouette(const CameraModel& video, int margin)
    : projection_(video), margin_(margin + kSlack), tileCount_(tilesOf(video.size)),
      tiles_(static_cast<std::size_t>(tileCount_.width) * tileCount_.height) {}

const std::vector<SurfaceRange>& Silhouette::run(std::span<const VirtualObject> objects,
                                                 const RigidTransform& T_world_video) {
    std::fill(tiles_.begin(), tiles_.end(), SurfaceRange{});
    for (const VirtualObject& object : objects)
        for (const SurfaceExtent& extent : projection_(object, T_world_video))
            add(extent);
    return tiles_;
}

const std::vector<SurfaceRange>& Silhouette::run(SceneBoxes& scene,
                                                 const RigidTransform& T_world_video) {
    std::fill(tiles_.begin(), tiles_.end(), SurfaceRange{});
    for (const SurfaceExtent& extent : scene.extents(projection_.lens(), T_world_video))
        add(extent);
    return tiles_;
}

void Silhouette::add(const SurfaceExtent& extent) {
    const Eigen::Array2d least = ((extent.pixels.min().array() - margin_) / kTileSize).floor();
    const Eigen::Array2d most = ((extent.pixels.max().array() + margin_) / kTileSize).floor();
    const double right = tileCount_.width - 1, bottom = tileCount_.height - 1;
    const int x0 = static_cast<int>(std::clamp(least.x(), 0.0, right + 1));
    const int y0 = static_cast<int>(std::clamp(least.y(), 0.0, bottom + 1));
    const int x1 = static_cast<int>(std::clamp(most.x(), -1.0, right));
    const int y1 = static_cast<int>(std::clamp(most.y(), -1.0, bottom));
    // Rounding outwards keeps the range of depth from becoming too small.
    const float nearest = std::nextafter(static_cast<float>(extent.nearest), 0.0F);
    const float farthest = std::nextafter(static_cast<float>(extent.farthest), 1e9F);
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            SurfaceRange& tile = tiles_[static_cast<std::size_t>(y) * tileCount_.width + x];
            tile.nearest = tile.farthest > 0 ? std::min(tile.nearest, nearest) : nearest;
            tile.farthest = std::max(tile.farthest, farthest);
        }
    }
}

}  // namespace mfar
