#pragma once

#include "pipeline/scene/scene.h"

#include <ranges>
#include <vector>

namespace mfar {

[[nodiscard]] inline auto meshesOf(const SceneObject& object) {
    return object.model->meshes |
           std::views::filter([part = object.part](const Mesh& m) { return m.part == part; });
}

/// Returns one object for each part of `whole.model` that has a mesh. Moving parts get their path
/// and their pose at time 0.
[[nodiscard]] std::vector<SceneObject> partsOf(const SceneObject& whole);

[[nodiscard]] bool moves(const Scene& scene);

/// Returns the objects' poses T_world_object at this time.
[[nodiscard]] std::vector<RigidTransform> posesAt(const Scene& scene, Timestamp time);
[[nodiscard]] Scene withPoses(const Scene& scene, const std::vector<RigidTransform>& poses);
[[nodiscard]] Scene sceneAt(const Scene& scene, Timestamp time);

}  // namespace mfar
