#include "pipeline/scene/scene_bounds.h"

namespace mfar {

Eigen::AlignedBox3d boundsIn(const RigidTransform& T_frame_world, const SceneObject& object) {
    const RigidTransform T = T_frame_world * object.T_world_object;
    Eigen::AlignedBox3d box;
    for (const Mesh& mesh : object.model->meshes)
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
