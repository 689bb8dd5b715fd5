#pragma once

#include "pipeline/scene/scene.h"

#include <Eigen/Geometry>

#include <optional>
#include <vector>

namespace mfar {

/// Bounding ball of an object [m].
struct ObjectBall {
    Eigen::Vector3d centre{0, 0, 0};
    double radius = 0;
};

/// Returns the bounding ball in the object's own frame, but with the object's scale applied [m].
/// The result is empty if the object has no vertices.
[[nodiscard]] std::optional<ObjectBall> ownBall(const SceneObject& object);
/// Returns one ball in the world for each object that has vertices, at its present pose.
[[nodiscard]] std::vector<ObjectBall> objectBalls(const Scene& scene);

/// Returns a ball around the shadow catcher in the world; empty if the scene has no catcher.
[[nodiscard]] std::optional<ObjectBall> catcherBall(const Scene& scene);

/// Returns the bounds of the object in the given frame. They contain a moving object at many times
/// of its motion: at its keyframes, and at times that are evenly spaced.
[[nodiscard]] Eigen::AlignedBox3d boundsIn(const RigidTransform& T_frame_world,
                                           const SceneObject& object);

/// Returns the bounds of all objects in world coordinates, see boundsIn(). They are empty if the
/// scene has no vertex.
[[nodiscard]] Eigen::AlignedBox3d boundsOf(const Scene& scene);

}  // namespace mfar
