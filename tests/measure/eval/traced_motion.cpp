#include "tests/measure/eval/traced_motion.h"

#include "pipeline/composite/lens_projection.h"
#include "tests/measure/eval/warp_scenes.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace mfar::eval {
namespace {

/// Returns for each object the transform from camera coordinates now to those before, of points
/// that are fixed to the object.
std::vector<RigidTransform> motionsOf(const PosedPicture& before, const PosedPicture& now) {
    const RigidTransform T_before_world = before.picture.T_world_camera.inverse();
    std::vector<RigidTransform> out;
    for (std::size_t i = 0; i < now.poses.size(); ++i)
        out.push_back(T_before_world * before.poses.at(i) * now.poses[i].inverse() *
                      now.picture.T_world_camera);
    return out;
}

}  // namespace

cv::Mat motionTo(const PosedPicture& before, const PosedPicture& now) {
    const CameraModel& camera = now.picture.camera;
    const Size size = camera.size;
    const LensProjection lens(camera);
    const std::vector<RigidTransform> motions = motionsOf(before, now);
    constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
    cv::Mat out(size.height, size.width, CV_32FC2, cv::Scalar(kUnknown, kUnknown));
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * size.width + x;
            if (!showsObject(now.picture, i)) continue;
            const std::uint8_t id = now.picture.id[i];
            const Eigen::Vector3d h =
                lens(motions.at(id - 1U) * (static_cast<double>(now.picture.depth[i]) *
                                            camera.unproject({x, y}).homogeneous()));
            if (!(h.z() > LensProjection::kNear)) continue;
            const Eigen::Vector2d at = h.hnormalized();
            const auto u = std::lround(at.x()), v = std::lround(at.y());
            if (u < 0 || v < 0 || u >= size.width || v >= size.height) continue;
            if (before.picture.id[static_cast<std::size_t>(v) * size.width + u] != id) continue;
            out.at<cv::Vec2f>(y, x) = {static_cast<float>(at.x() - x),
                                       static_cast<float>(at.y() - y)};
        }
    return out;
}

}  // namespace mfar::eval
