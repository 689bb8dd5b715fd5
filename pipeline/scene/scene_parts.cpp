#include "pipeline/scene/scene_parts.h"

#include <algorithm>

namespace mfar {

std::vector<SceneObject> partsOf(const SceneObject& whole) {
    std::vector<SceneObject> out;
    const int parts = static_cast<int>(whole.model->paths.size());
    for (int part = 0; part <= parts; ++part) {
        SceneObject object = whole;
        object.part = part;
        if (meshesOf(object).empty()) continue;
        if (part > 0) {
            const RigidPath& path = whole.model->paths[static_cast<std::size_t>(part) - 1];
            object.path = std::make_shared<const RigidPath>(
                path.placed(whole.T_world_object, static_cast<double>(whole.scale)));
            object.T_world_object = object.path->at(0);
        }
        out.push_back(std::move(object));
    }
    return out;
}

bool moves(const Scene& scene) {
    return std::ranges::any_of(scene.objects,
                               [](const SceneObject& o) { return o.path != nullptr; });
}

std::vector<RigidTransform> posesAt(const Scene& scene, Timestamp time) {
    std::vector<RigidTransform> out;
    out.reserve(scene.objects.size());
    for (const SceneObject& object : scene.objects)
        out.push_back(object.path ? object.path->at(time.seconds()) : object.T_world_object);
    return out;
}

Scene withPoses(const Scene& scene, const std::vector<RigidTransform>& poses) {
    Scene out = scene;
    for (std::size_t i = 0; i < out.objects.size(); ++i)
        out.objects[i].T_world_object = poses[i];
    return out;
}

Scene sceneAt(const Scene& scene, Timestamp time) {
    return withPoses(scene, posesAt(scene, time));
}

}  // namespace mfar
