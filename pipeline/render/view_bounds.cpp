#include "pipeline/render/view_bounds.h"

#include <array>
#include <limits>

namespace mfar {
namespace {

// Distance [m] of the near plane from the camera. Parts of a box nearer than this are cut off.
constexpr double kNearest = 1e-4;

struct RayRange {
    Eigen::Vector2f least = Eigen::Vector2f::Constant(std::numeric_limits<float>::infinity());
    Eigen::Vector2f most = -least;

    void add(const Eigen::Vector3d& p) {
        const Eigen::Vector2f ray = (p.head<2>() / p.z()).cast<float>();
        least = least.cwiseMin(ray);
        most = most.cwiseMax(ray);
    }
};

}  // namespace

PixelRect pixelsOfBox(const Eigen::AlignedBox3f& box, const RenderView& view,
                      const LensRays& rays) {
    if (box.isEmpty()) return {};
    const RigidTransform T_camera_world = view.T_world_camera.inverse();
    std::array<Eigen::Vector3d, 8> corners;
    for (unsigned i = 0; i < 8; ++i)
        corners[i] = T_camera_world *
                     box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(i)).cast<double>();
    RayRange range;
    for (unsigned i = 0; i < 8; ++i) {
        if (corners[i].z() >= kNearest) range.add(corners[i]);
        for (const unsigned axis : {1U, 2U, 4U}) {
            const Eigen::Vector3d &a = corners[i], &b = corners[i ^ axis];
            if (!(a.z() >= kNearest && b.z() < kNearest)) continue;
            Eigen::Vector3d cut = a + (b - a) * ((a.z() - kNearest) / (a.z() - b.z()));
            cut.z() = kNearest;
            range.add(cut);
        }
    }
    return rays.pixelsIn(range.least, range.most);
}

}  // namespace mfar
