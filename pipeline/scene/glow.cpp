#include "pipeline/scene/glow.h"

#include "base/luminance.h"
#include "pipeline/scene/scene_bounds.h"
#include "pipeline/scene/scene_parts.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace mfar {
namespace {

constexpr double kVisible = 0.005;

/// Returns the sum of area times radiance of the model's triangles [W/sr]. It ignores emission
/// textures, so it is an upper limit.
double intensityOf(const SceneObject& object) {
    double sum = 0;
    for (const Mesh& mesh : meshesOf(object)) {
        const auto material = static_cast<std::size_t>(mesh.material);
        if (material >= object.model->materials.size()) continue;
        const double radiance = luminanceOf<float>(object.model->materials[material].emission);
        if (!(radiance > 0)) continue;
        double area = 0;
        for (const auto& [a, b, c] : mesh.triangles) {
            const Eigen::Vector3f& corner = mesh.positions[a];
            area += 0.5 * (mesh.positions[b] - corner).cross(mesh.positions[c] - corner).norm();
        }
        sum += radiance * area;
    }
    return sum * object.scale * object.scale;
}

/// Returns the irradiance from the sun on a surface that faces it, plus the irradiance from the
/// environment on a surface of average direction.
double irradianceOf(const Lighting& lighting) {
    double sum = lighting.sun ? luminanceOf<float>(lighting.sun->irradiance) : 0;
    if (!lighting.environment) return sum;
    const auto& [size, radiance] = *lighting.environment;
    double light = 0, weights = 0;
    for (int y = 0; y < size.height; ++y) {
        const double weight = std::sin((y + 0.5) / size.height * std::numbers::pi);
        const std::size_t row = static_cast<std::size_t>(y) * size.width;
        for (int x = 0; x < size.width; ++x)
            light += weight * luminanceOf<float>(radiance[row + x]);
        weights += weight * size.width;
    }
    return weights > 0 ? sum + std::numbers::pi * light / weights : sum;
}

}  // namespace

double glowDistance(const Scene& scene) {
    double intensity = 0;
    for (const SceneObject& object : scene.objects)
        intensity += intensityOf(object);
    if (!(intensity > 0)) return 0;
    return std::sqrt(intensity / (kVisible * irradianceOf(scene.lighting)));
}

double glowReach(double glowDistance, double diagonal) {
    // Shadows are expected up to about one diagonal of the objects' common box away from the box's
    // centre.
    const double reach = glowDistance / diagonal;
    return reach >= 1 ? std::min(reach, kMostGlowReach) : 1;
}

double glowReach(const Scene& scene) {
    return glowReach(glowDistance(scene), boundsOf(scene).diagonal().norm());
}

}  // namespace mfar
