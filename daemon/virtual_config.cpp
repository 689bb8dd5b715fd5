#include "daemon/virtual_config.h"

#include "daemon/toml_reader.h"
#include "pipeline/models/environment_map.h"
#include "pipeline/models/gltf_model.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace mfar {
namespace {

template <class E>
using Meaning = std::pair<std::string_view, E>;

constexpr std::array<Meaning<VirtualRendering>, 2> kRenderings = {
    {{"path-traced", VirtualRendering::PathTraced}, {"preview", VirtualRendering::Preview}}};
constexpr std::array<Meaning<Slicing>, 2> kSlicings = {
    {{"time", Slicing::Time}, {"space", Slicing::Spatial}}};
constexpr std::array<Meaning<HoleFilling>, 4> kHoleFillings = {
    {{"none", HoleFilling::None},
     {"push-pull", HoleFilling::PushPull},
     {"re-render", HoleFilling::Rerender},
     {"both", HoleFilling::Both}}};

std::optional<std::string> directionFault(std::span<const double> xyz) {
    if (std::hypot(xyz[0], xyz[1], xyz[2]) > 1e-3) return std::nullopt;
    return "must not be zero";
}

void readSun(TomlReader& file, std::optional<Sun>& sun) {
    Eigen::Vector3d towards = Eigen::Vector3d::Zero(), irradiance = Eigen::Vector3d::Constant(-1);
    double radiusDeg = 0;
    file.numbers("light.sun.direction", {towards.data(), 3}, directionFault);
    file.numbers("light.sun.irradiance", {irradiance.data(), 3});
    file.number("light.sun.radius_deg", radiusDeg);
    if (!file.placeOf("light.sun")) return;
    sun.emplace();
    sun->towards.normalize();
    if (!towards.isZero()) sun->towards = towards.normalized().cast<float>();
    if (irradiance.x() >= 0) sun->irradiance = irradiance.cast<float>();
    if (radiusDeg > 0) sun->angularRadius = static_cast<float>(radiusDeg * std::numbers::pi / 180);
}

std::optional<std::string> takeEnvironment(std::string_view name,
                                           const std::filesystem::path& folder, FileMemory& memory,
                                           LightOptions& light) {
    constexpr std::array<Meaning<LightSource>, 3> kSources = {{{"studio", LightSource::Studio},
                                                               {"sky", LightSource::Sky},
                                                               {"camera", LightSource::Camera}}};
    for (const auto& [word, source] : kSources)
        if (word == name) {
            light.source = source;
            return std::nullopt;
        }
    try {
        light.environment =
            std::make_shared<const Environment>(loadEnvironment(folder / name, memory.left()));
        memory.take(light.environment->radiance.size() * sizeof(Eigen::Vector3f));
        light.source = LightSource::File;
        return std::nullopt;
    } catch (const ModelError& error) {
        return std::string("must be \"studio\", \"sky\", \"camera\" or a picture; ") + error.what();
    }
}

}  // namespace

void readVirtual(TomlReader& file, VirtualOptions& options) {
    file.choice<VirtualRendering>("virtual.rendering", options.rendering, kRenderings);
    file.number("virtual.budget_ms", options.budgetMs);
    file.choice<Slicing>("virtual.slicing", options.slicing, kSlicings);
    file.integer("virtual.samples", options.samples);
    file.number("virtual.resolution", options.resolution);
    file.choice<HoleFilling>("virtual.holes", options.holes, kHoleFillings);
    file.integer("virtual.threads", options.threads);
    file.boolean("virtual.filter", options.filter);
    file.number("virtual.turn_deg", options.turnDeg);
}

void readLight(TomlReader& file, const std::filesystem::path& folder, FileMemory& memory,
               LightOptions& light) {
    std::string name;
    file.text("light.environment", name, [&](std::string_view given) {
        return takeEnvironment(given, folder, memory, light);
    });
    if (light.source == LightSource::File) light.file = name;
    readSun(file, light.sun);
    double exposure = light.exposure;
    file.number("light.exposure", exposure);
    light.exposure = static_cast<float>(exposure);
}

}  // namespace mfar
