#include "pipeline/simd/depth_splat.h"

#include "pipeline/render/rendered_picture.h"
#include "pipeline/simd/surface_raster.h"

#include <algorithm>
#include <cmath>

namespace mfar::simd {
namespace {

// Pixels reach those of their four neighbours where their bilinear weight is that or more.
constexpr float kLeastShare = 0.25F;

bool isSameCamera(const CameraModel& a, const CameraModel& b) {
    return a.size == b.size && a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy &&
           a.distortion == b.distortion;
}

}  // namespace

DepthSplat::DepthSplat(const LensProjection& layer)
    : lens_(pointLensOf(layer)), objects_(layer.camera.size), catcher_(layer.camera.size) {}

void DepthSplat::run(const WarpReference& reference, const RigidTransform& T_world_camera,
                     const PixelRect& where) {
    const CameraModel& camera = reference.camera;
    if (!raysOf_ || !isSameCamera(*raysOf_, camera)) {
        raysOf_ = camera;
        rayX_ = AlignedRows<float>(camera.size);
        rayY_ = AlignedRows<float>(camera.size);
        for (int y = 0; y < camera.size.height; ++y)
            for (int x = 0; x < camera.size.width; ++x) {
                const Eigen::Vector2f ray = camera.unproject(Eigen::Vector2d(x, y)).cast<float>();
                rayX_[y][x] = ray.x();
                rayY_[y][x] = ray.y();
            }
    }
    for (int y = where.y0; y < where.y1; ++y) {
        std::fill(objects_[y] + where.x0, objects_[y] + where.x1, 0.0F);
        std::fill(catcher_[y] + where.x0, catcher_[y] + where.x1, 0.0F);
    }
    const PointTransform view =
        pointTransformOf(T_world_camera.inverse() * reference.T_world_camera);
    for (int y = reference.bounds.y0; y < reference.bounds.y1; ++y)
        for (int x = reference.bounds.x0; x < reference.bounds.x1; ++x) {
            const WarpSurface& s =
                reference.surface[static_cast<std::size_t>(y) * camera.size.width + x];
            if (!(s.z > 0)) continue;
            const Point3 p = transformed(view, {s.z * rayX_[y][x], s.z * rayY_[y][x], s.z});
            if (!(p.z > lens_.nearest && p.z < 1e6F)) continue;
            const Point3 h = projected(lens_, p);
            splat(s.id == kCatcherId ? catcher_ : objects_, {h.x / h.z, h.y / h.z, p.z}, where);
        }
}

/// The nearest z wins, in whatever order they come.
void DepthSplat::splat(AlignedRows<float>& to, const Point3& at, const PixelRect& where) const {
    const Size size = to.size();
    if (!(at.x > -1 && at.y > -1 && at.x < static_cast<float>(size.width) &&
          at.y < static_cast<float>(size.height)))
        return;
    const float lowX = std::floor(at.x), lowY = std::floor(at.y), fx = at.x - lowX,
                fy = at.y - lowY;
    for (int i = 0; i < 4; ++i) {
        const int right = i & 1, down = i >> 1;
        const int x = static_cast<int>(lowX) + right, y = static_cast<int>(lowY) + down;
        const float share = (right != 0 ? fx : 1 - fx) * (down != 0 ? fy : 1 - fy);
        if (share < kLeastShare || x < where.x0 || y < where.y0 || x >= where.x1 || y >= where.y1)
            continue;
        float& z = to[y][x];
        if (z == 0 || at.z < z) z = at.z;
    }
}

}  // namespace mfar::simd
