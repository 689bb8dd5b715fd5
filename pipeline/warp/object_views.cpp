#include "pipeline/warp/object_views.h"

namespace mfar {

std::vector<RigidTransform> viewsOfObjects(const RigidTransform& T_world_view,
                                           std::span<const RigidTransform> poses,
                                           std::span<const SilhouetteModels::Object> objects,
                                           const RigidTransform& T_world_camera) {
    if (poses.empty() || poses.size() != objects.size()) return {};
    const RigidTransform T_view_world = T_world_view.inverse();
    std::vector<RigidTransform> out{T_view_world * T_world_camera};
    for (std::size_t i = 0; i < poses.size(); ++i)
        out.push_back(T_view_world * poses[i] * objects[i].T_world_object.inverse() *
                      T_world_camera);
    return out;
}

}  // namespace mfar
