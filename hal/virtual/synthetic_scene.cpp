#include "hal/virtual/synthetic_scene.h"

#include "hal/virtual/synthetic_build.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace mfar::synthetic {
RigidTransform World::moverPose(double t) const {
    const double turn = 2 * std::numbers::pi * t;
    const Eigen::Quaterniond yaw(
        Eigen::AngleAxisd(0.45 * std::sin(turn / 4.3), Eigen::Vector3d::UnitZ()));
    const Eigen::Vector3d shift{0.075 * std::sin(turn / 3.7), 0.03 * std::sin(turn / 2.9 + 0.8), 0};
    return {yaw, moverPivot + shift - yaw * moverPivot};
}

RigidTransform World::primitivePose(int index, double t) const {
    const Primitive& p = primitives[index];
    return p.moves ? moverPose(t) * p.T_world_prim : p.T_world_prim;
}

World makeWorld(Scene scene, std::uint64_t seed) {
    switch (scene) {
    case Scene::Shelf: return makeShelf(seed);
    case Scene::Outdoor: return makeOutdoor(seed);
    case Scene::Flat: return makeFlat(seed);
    case Scene::Moving: return makeOffice(seed, true);
    case Scene::Calibration: return makeCalibration();
    case Scene::Office:
    case Scene::Still: break;
    }
    return makeOffice(seed, false);
}

}  // namespace mfar::synthetic
