#include "hal/virtual/synthetic_scene.h"

#include "hal/virtual/synthetic_build.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace mfar::synthetic {
namespace {

template <class T, std::size_t N>
using Names = std::array<std::pair<T, std::string_view>, N>;

constexpr Names<Scene, 7> kScenes{{{Scene::Office, "office"},
                                   {Scene::Shelf, "shelf"},
                                   {Scene::Outdoor, "outdoor"},
                                   {Scene::Flat, "flat"},
                                   {Scene::Moving, "moving"},
                                   {Scene::Still, "still"},
                                   {Scene::Calibration, "calibration"}}};
constexpr Names<Path, 7> kPaths{{{Path::Handheld, "handheld"},
                                 {Path::Pan, "pan"},
                                 {Path::Orbit, "orbit"},
                                 {Path::Forward, "forward"},
                                 {Path::Rotate, "rotate"},
                                 {Path::Rest, "rest"},
                                 {Path::Survey, "survey"}}};

template <class T, std::size_t N>
std::string_view nameIn(const Names<T, N>& names, T value) {
    return std::ranges::find(names, value, &std::pair<T, std::string_view>::first)->second;
}

template <class T, std::size_t N>
std::optional<T> namedIn(const Names<T, N>& names, std::string_view name) {
    const auto at = std::ranges::find(names, name, &std::pair<T, std::string_view>::second);
    if (at == names.end()) return std::nullopt;
    return at->first;
}

}  // namespace

std::string_view name(Scene scene) {
    return nameIn(kScenes, scene);
}
std::string_view name(Path path) {
    return nameIn(kPaths, path);
}
std::optional<Scene> sceneNamed(std::string_view name) {
    return namedIn(kScenes, name);
}
std::optional<Path> pathNamed(std::string_view name) {
    return namedIn(kPaths, name);
}

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
