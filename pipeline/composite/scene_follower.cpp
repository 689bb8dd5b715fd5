#include "pipeline/composite/scene_follower.h"

#include <cmath>
#include <utility>

namespace mfar {
namespace {

constexpr std::size_t kLeastTriangles = 50;

double knownShare(const InverseDepthField& field, const PixelRect& region) {
    std::size_t known = 0, all = 0;
    for (int y = region.y0; y < region.y1; ++y)
        for (int x = region.x0; x < region.x1; ++x, ++all)
            known += field.isKnown(static_cast<std::size_t>(y) * field.size.width + x) ? 1 : 0;
    return all > 0 ? static_cast<double>(known) / static_cast<double>(all) : 0;
}

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

std::shared_ptr<const Scene> SceneFollower::set(Scene scene) {
    scene_ = std::move(scene);
    planes_ = groundPlanes(scene_);
    const Eigen::Vector3f albedo = scene_.catcher.albedo;
    scene_.catcher = planeCatcher(planes_);
    scene_.catcher.albedo = albedo;
    frames_ = 0;
    caught_.reset();
    return std::make_shared<const Scene>(scene_);
}

std::shared_ptr<const Scene> SceneFollower::relight(Lighting lighting) {
    scene_.lighting = std::move(lighting);
    return std::make_shared<const Scene>(scene_);
}

bool SceneFollower::isDue(const RigidTransform& T_world_video, Timestamp time) const {
    if (frames_ < rule_.settling) return false;
    if (!caught_) return true;
    const double age = secondsBetween(*caught_, time);
    const Eigen::Vector3d centre = planes_.front().objects.center();
    return age >= rule_.leastInterval &&
           angleBetween(caughtFrom_ - centre, T_world_video.translation - centre) >= rule_.turn;
}

std::shared_ptr<const Scene> SceneFollower::follow(const RealDepth& depth,
                                                   const PixelRect& region) {
    const auto& [field, where, video, T_world_video, time] = depth;
    const PixelRect seen = common(region, {0, 0, field.size.width, field.size.height});
    if (planes_.empty() || planes_.front().objects.isEmpty() || seen.empty()) return nullptr;
    ++frames_;
    if (around(where, seen) != where) return nullptr;
    if (!isDue(T_world_video, time) || knownShare(field, seen) < rule_.leastKnown) return nullptr;
    ShadowCatcher measured = depthCatcher(field, video, T_world_video, seen, planes_);
    if (measured.triangles.size() < kLeastTriangles) return nullptr;
    addUnseen(measured, planes_, video, T_world_video);
    measured.albedo = scene_.catcher.albedo;
    scene_.catcher = std::move(measured);
    caught_ = time;
    caughtFrom_ = T_world_video.translation;
    return std::make_shared<const Scene>(scene_);
}

}  // namespace mfar
