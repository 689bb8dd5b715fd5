#include "pipeline/composite/lens_projection.h"

#include "pipeline/epipolar/epipolar_lens.h"

#include <algorithm>

namespace mfar {
namespace {

// Upper limit of LensProjection::rim, as a multiple of the radius of the picture's corners. It is
// so large that the changed projection beyond the rim affects no visible pixel.
constexpr double kBeyondPicture = 2;

}  // namespace

LensProjection::LensProjection(const CameraModel& model)
    : camera(model), rim(rimOf(model, cornerRadius(model), kBeyondPicture)) {
    const auto& k = camera.distortion;
    const double q = rim * rim;
    rimRadial = 1 + q * (k[0] + q * (k[1] + q * k[4]));
}

Eigen::Vector3d LensProjection::operator()(const Eigen::Vector3d& p) const {
    const Eigen::Vector2d xy = p.head<2>();
    const double z = p.z(), r = xy.norm();
    const bool within = z * rim > r;
    const Eigen::Vector2d held = xy * (within ? 1 / z : rim / std::max(r, 1e-12));
    Eigen::Vector2d pixel = z * camera.project(held);
    if (!within)
        pixel += rimRadial * Eigen::Vector2d(camera.fx, camera.fy).cwiseProduct(xy - z * held);
    return {pixel.x(), pixel.y(), z};
}

}  // namespace mfar
