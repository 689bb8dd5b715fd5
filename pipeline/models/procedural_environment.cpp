#include "pipeline/models/environment_map.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace mfar {
namespace {

constexpr Size kProceduralSize{512, 256};
constexpr float kHalfTurn = std::numbers::pi_v<float>;

/// Scales an environment so that a white surface that faces up has a green radiance of 1.
Environment balanced(Environment environment) {
    double irradiance = 0;
    for (int y = 0; y < environment.size.height; ++y) {
        const double fromUp = (y + 0.5) * kHalfTurn / environment.size.height;
        const double weight = std::max(std::cos(fromUp), 0.0) * std::sin(fromUp);
        for (int x = 0; x < environment.size.width; ++x)
            irradiance +=
                weight *
                environment.radiance[static_cast<std::size_t>(y) * environment.size.width + x].y();
    }
    irradiance *= 2 * std::pow(kHalfTurn, 2) / environment.size.width / environment.size.height;
    const auto scale = static_cast<float>(kHalfTurn / irradiance);
    for (Eigen::Vector3f& value : environment.radiance)
        value *= scale;
    return environment;
}

float smoothStep(float from, float to, float x) {
    const float t = std::clamp((x - from) / (to - from), 0.0F, 1.0F);
    return t * t * (3 - 2 * t);
}

/// A lamp behind a diffuser with a frame. It faces the origin, and its top edge is horizontal.
struct Panel {
    Eigen::Vector3f middle;  ///< [m]
    Eigen::Vector2f half;    ///< half of the width and half of the height [m]
    Eigen::Vector3f radiance;
};

Eigen::Vector3f panelLight(const Panel& panel, const Eigen::Vector3f& direction) {
    const float distance = panel.middle.norm();
    const Eigen::Vector3f normal = panel.middle / distance,
                          side = normal.cross(Eigen::Vector3f::UnitZ()).normalized(),
                          up = side.cross(normal);
    const float along = direction.dot(normal);
    if (!(along > 0)) return Eigen::Vector3f::Zero();
    const Eigen::Vector3f hit = direction * (distance / along);
    const Eigen::Vector2f at(hit.dot(side) / panel.half.x(), hit.dot(up) / panel.half.y());
    // The diffuser is darker at its edge than in front of the lamp.
    constexpr float kRim = 0.06F, kDarkening = 0.35F;
    const float inside = smoothStep(1 + kRim, 1 - kRim, std::abs(at.x())) *
                         smoothStep(1 + kRim, 1 - kRim, std::abs(at.y()));
    return panel.radiance * (inside * (1 - kDarkening * std::min(at.squaredNorm() / 2, 1.0F)));
}

Eigen::Vector3f studioLight(const Eigen::Vector3f& direction) {
    static const std::array<Panel, 3> kPanels = {
        {{{-1.9F, -1.5F, 2.4F}, {0.95F, 0.75F}, {9.5F, 8.9F, 8.0F}},
         {{2.4F, -0.7F, 1.1F}, {0.22F, 1.1F}, {4.4F, 4.7F, 5.2F}},
         {{0.7F, 2.6F, 1.5F}, {1.3F, 0.3F}, {3.4F, 4.0F, 5.0F}}}};
    const Eigen::Vector3f wall(0.20F, 0.205F, 0.215F), ceiling(0.42F, 0.42F, 0.43F),
        floor(0.17F, 0.14F, 0.115F);
    const float up = smoothStep(0, 0.9F, direction.z()),
                down = smoothStep(0.02F, -0.12F, direction.z());
    Eigen::Vector3f light = wall + up * (ceiling - wall);
    light += down * (floor - light);
    for (const Panel& panel : kPanels)
        light += panelLight(panel, direction);
    return light;
}

/// Returns the relative luminance of the sky at a zenith angle, given by its cosine, and an angle
/// from the sun [rad] (CIE S 011, type 12).
float clearSky(float cosZenith, float fromSun) {
    constexpr float kB = -0.32F, kC = 10, kD = -3, kE = 0.45F;
    const float gradation = 1 - std::exp(kB / std::max(cosZenith, 0.01F));
    const float indicatrix = 1 + kC * (std::exp(kD * fromSun) - std::exp(kD * kHalfTurn / 2)) +
                             kE * std::pow(std::cos(fromSun), 2.0F);
    return gradation * indicatrix;
}

}  // namespace

Environment studioEnvironment() {
    return balanced(environmentOf(kProceduralSize, studioLight));
}

Environment skyEnvironment(const Eigen::Vector3f& towardsSun) {
    const Eigen::Vector3f blue(0.42F, 0.66F, 1.15F), haze(1.0F, 0.97F, 0.93F),
        ground(0.26F, 0.24F, 0.21F);
    const auto light = [&](const Eigen::Vector3f& direction) -> Eigen::Vector3f {
        const float fromSun = std::acos(std::clamp(direction.dot(towardsSun), -1.0F, 1.0F));
        const float whiter =
            std::max(std::exp(-4 * fromSun), 1 - smoothStep(0, 0.35F, direction.z()));
        const Eigen::Vector3f colour = blue + 0.8F * whiter * (haze - blue);
        const Eigen::Vector3f sky = clearSky(direction.z(), fromSun) * colour;
        return sky + smoothStep(0.01F, -0.03F, direction.z()) * (ground - sky);
    };
    return balanced(environmentOf(kProceduralSize, light));
}

}  // namespace mfar
