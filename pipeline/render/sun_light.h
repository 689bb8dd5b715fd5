#pragma once

#include "pipeline/render/light_sample.h"
#include "pipeline/scene/scene.h"

#include <cmath>
#include <optional>

namespace mfar {

/// The sun as a disc of constant radiance, sampled uniformly in solid angle.
class SunLight {
public:
    explicit SunLight(const std::optional<Sun>& sun);

    [[nodiscard]] bool dark() const { return density_ == 0; }
    [[nodiscard]] Eigen::Vector3f towards() const { return frame_.col(2); }
    [[nodiscard]] const Eigen::Vector3f& irradiance() const { return irradiance_; }
    /// Approximate angular radius of the disc [rad]; too small by 1 % at 0.5 rad.
    [[nodiscard]] float angularRadius() const { return std::sqrt(chord2_); }
    [[nodiscard]] LightSample sample(const Eigen::Vector2f& u) const;
    /// Returns the sun's radiance from `direction`, or 0 outside the disc. `direction` must have
    /// unit length.
    [[nodiscard]] Eigen::Vector3f radiance(const Eigen::Vector3f& direction) const;
    [[nodiscard]] float density(const Eigen::Vector3f& direction) const;

private:
    [[nodiscard]] bool holds(const Eigen::Vector3f& direction) const;

    Eigen::Matrix3f frame_ = Eigen::Matrix3f::Identity();
    Eigen::Vector3f irradiance_{0, 0, 0}, radiance_{0, 0, 0};
    float chord2_ = 0;  // squared chord of the unit sphere from the disc's centre to its rim
    float density_ = 0;
};

}  // namespace mfar
