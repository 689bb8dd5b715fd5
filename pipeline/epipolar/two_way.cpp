#include "pipeline/epipolar/two_way.h"

#include "pipeline/epipolar/near_plane.h"

#include <cmath>

namespace mfar {
namespace {

/// Where another camera shows the point of a ray: s as EpipolarLens has it.
std::optional<Eigen::Vector2d> seenFrom(const Eigen::Vector2d& ray, double s,
                                        const RigidTransform& T_there_here,
                                        const CameraModel& there) {
    const Eigen::Vector3d t = T_there_here.rotation.conjugate() * T_there_here.translation;
    const Eigen::Vector3d moved(ray.x() + s * (t.x() - ray.x() * t.z()),
                                ray.y() + s * (t.y() - ray.y() * t.z()), 1);
    const Eigen::Vector3d p = T_there_here.rotation * moved;
    if (!(p.z() > kNearPlane)) return std::nullopt;
    return there.project(p.hnormalized());
}

}  // namespace

TwoWayTest::TwoWayTest(const StereoRig& rig, std::shared_ptr<Workers> workers,
                       const EpipolarOptions& options)
    : video_(rig.video), still_(atScaleOf(rig)),
      backward_({still_, video_, rig.T_still_video.inverse()}, std::move(workers), options) {}

void TwoWayTest::run(const EpipolarSearch& forward, const ImageView& frame) {
    backward_.setStill(frame);
    searchBack(forward);
}

void TwoWayTest::run(const EpipolarSearch& forward, const Rows<const std::uint8_t>& frame) {
    backward_.setStill(frame);
    searchBack(forward);
}

void TwoWayTest::searchBack(const EpipolarSearch& forward) {
    pose_ = forward.pose();
    backward_.run(forward.stillPicture(), pose_.inverse());
}

std::optional<float> TwoWayTest::error(const Eigen::Vector2d& ray, double s) const {
    const auto there = seenFrom(ray, s, pose_, still_);
    if (!there) return std::nullopt;
    const double x = std::round(there->x()), y = std::round(there->y());
    if (!(x >= 0 && y >= 0 && x < still_.size.width && y < still_.size.height)) return std::nullopt;
    const auto pixel =
        static_cast<std::size_t>(y) * still_.size.width + static_cast<std::size_t>(x);
    const auto back = seenFrom(still_.unproject(*there), backward_.inverseDepth()[pixel],
                               pose_.inverse(), video_);
    if (!back) return std::nullopt;
    return static_cast<float>((*back - video_.project(ray)).norm());
}

}  // namespace mfar
