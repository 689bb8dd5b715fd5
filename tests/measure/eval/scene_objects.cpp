#include "tests/measure/eval/scene_objects.h"

namespace mfar::eval {
namespace {

VirtualObject sphereAt(const Eigen::Vector3d& middle) {
    VirtualObject out;
    out.shape = VirtualShape::Sphere;
    out.size.setConstant(0.3);
    out.T_world_object.translation = middle;
    return out;
}

}  // namespace

std::vector<VirtualObject> sceneObjects(synthetic::Scene scene) {
    switch (scene) {
    case synthetic::Scene::Office: return {sphereAt({0.02, 0.42, 0.16})};
    case synthetic::Scene::Shelf: return {sphereAt({0.25, 0.35, 0.4})};
    default: return {};
    }
}

}  // namespace mfar::eval
