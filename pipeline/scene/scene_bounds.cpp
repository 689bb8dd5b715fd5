#include "pipeline/scene/scene_bounds.h"

#include "pipeline/scene/scene_parts.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mfar {
namespace {

/// The bounds of a moving object are computed from its poses at this number of times, evenly
/// spaced, and at its keyframes.
constexpr int kPoses = 64;

std::vector<double> timesOf(const RigidPath& path) {
    std::vector<double> out;
    for (int i = 0; i < kPoses; ++i)
        out.push_back(path.length * i / kPoses);
    for (const RigidPath::Joint& joint : path.joints)
        for (const MotionTrack* track : {&joint.translation, &joint.rotation})
            for (const double time : track->times) {
                out.push_back(time);
                // At time `length`, the path returns the pose of time 0, because the motion
                // repeats. The last pose of the motion is found just before.
                out.push_back(std::nextafter(time, 0.0));
            }
    // The tracks of most files have the same times.
    std::ranges::sort(out);
    out.erase(std::ranges::unique(out).begin(), out.end());
    return out;
}

/// Returns the bounds of the object at the times of timesOf(), from the corners of its own bounds.
Eigen::AlignedBox3d sweptBounds(const RigidTransform& T_frame_world, const SceneObject& object) {
    SceneObject atRest = object;
    atRest.path.reset();
    atRest.T_world_object = {};
    const Eigen::AlignedBox3d own = boundsIn({}, atRest);
    Eigen::AlignedBox3d box;
    if (own.isEmpty()) return box;
    for (const double time : timesOf(*object.path)) {
        const RigidTransform T = T_frame_world * object.path->at(time);
        for (int corner = 0; corner < 8; ++corner)
            box.extend(T * own.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
    }
    return box;
}

std::optional<ObjectBall> ballAround(const Eigen::AlignedBox3f& box, double scale) {
    if (box.isEmpty()) return {};
    return ObjectBall{scale * box.center().cast<double>(), 0.5 * scale * box.diagonal().norm()};
}

}  // namespace

std::optional<ObjectBall> ownBall(const SceneObject& object) {
    if (!object.model) return {};
    Eigen::AlignedBox3f box;
    for (const Mesh& mesh : meshesOf(object))
        for (const Eigen::Vector3f& p : mesh.positions)
            box.extend(p);
    return ballAround(box, object.scale);
}

std::vector<ObjectBall> objectBalls(const Scene& scene) {
    std::vector<ObjectBall> out;
    for (const SceneObject& object : scene.objects)
        if (const std::optional<ObjectBall> ball = ownBall(object))
            out.push_back({object.T_world_object * ball->centre, ball->radius});
    return out;
}

std::optional<ObjectBall> catcherBall(const Scene& scene) {
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& p : scene.catcher.positions)
        box.extend(p);
    return ballAround(box, 1);
}

Eigen::AlignedBox3d boundsIn(const RigidTransform& T_frame_world, const SceneObject& object) {
    if (object.path) return sweptBounds(T_frame_world, object);
    const RigidTransform T = T_frame_world * object.T_world_object;
    Eigen::AlignedBox3d box;
    for (const Mesh& mesh : meshesOf(object))
        for (const Eigen::Vector3f& p : mesh.positions)
            box.extend(T * (object.scale * p).cast<double>());
    return box;
}

Eigen::AlignedBox3d boundsOf(const Scene& scene) {
    Eigen::AlignedBox3d box;
    for (const SceneObject& object : scene.objects)
        box.extend(boundsIn({}, object));
    return box;
}

}  // namespace mfar
