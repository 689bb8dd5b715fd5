#include "pipeline/render/sun_light.h"

#include "pipeline/render/surface_scatter.h"

#include <cmath>
#include <numbers>

namespace mfar {

SunLight::SunLight(const std::optional<Sun>& sun) {
    if (!sun || !(sun->irradiance.maxCoeff() > 0)) return;
    constexpr float kPi = std::numbers::pi_v<float>;
    const float sine = std::sin(sun->angularRadius), half = std::sin(sun->angularRadius / 2);
    frame_ = frameAround(sun->towards.normalized());
    irradiance_ = sun->irradiance;
    radiance_ = sun->irradiance / (kPi * sine * sine);
    chord2_ = 4 * half * half;
    density_ = 1 / (kPi * chord2_);
}

LightSample SunLight::sample(const Eigen::Vector2f& u) const {
    // The inverse of Lambert's azimuthal projection maps a disc onto the spherical cap and
    // preserves area.
    const Eigen::Vector2f p = discPoint(u);
    const float d2 = chord2_ * p.squaredNorm();
    const Eigen::Vector2f side = p * std::sqrt(chord2_ * (1 - d2 / 4));
    return {frame_ * Eigen::Vector3f(side.x(), side.y(), 1 - d2 / 2), radiance_, density_};
}

bool SunLight::holds(const Eigen::Vector3f& direction) const {
    return (direction - frame_.col(2)).squaredNorm() <= chord2_;
}

Eigen::Vector3f SunLight::radiance(const Eigen::Vector3f& direction) const {
    return holds(direction) ? radiance_ : Eigen::Vector3f(0, 0, 0);
}

float SunLight::density(const Eigen::Vector3f& direction) const {
    return holds(direction) ? density_ : 0;
}

}  // namespace mfar
