#include "hal/virtual/synthetic_scene.h"

#include <algorithm>
#include <array>
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

}  // namespace mfar::synthetic
