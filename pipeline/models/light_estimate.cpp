#include "pipeline/models/light_estimate.h"

#include "base/image_layout.h"
#include "pipeline/models/environment_map.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

namespace mfar {
namespace {

constexpr Size kMap{32, 16};

constexpr float kY0 = 0.282095F, kY1 = 0.488603F;

/// Returns the weight of the prior in the ridge regression, for each of the nine coefficients. The
/// weight is A / B. A is the variance of the seen light about a sum of nine harmonics. It is
/// assumed that objects of about 0.25 sr are half or twice as bright as this sum. B is the variance
/// of the coefficient between scenes. The assumed standard deviations are 3, 1.5 and 0.7 times the
/// mean light for coefficients of degree 0, 1 and 2.
Eigen::Vector<double, 9> priorInformation() {
    Eigen::Vector<double, 9> out;
    out << 0.007, 0.03, 0.03, 0.03, 0.13, 0.13, 0.13, 0.13, 0.13;
    return out;
}

/// Returns the coefficients of the prior. All directions below the horizon have the radiance
/// `mean`. All directions above it have the radiance mean / albedo. A surface that faces up and has
/// this albedo then has the radiance `mean`, too.
Eigen::Matrix<double, 9, 3> priorLight(const Eigen::Vector3d& mean, double albedo) {
    constexpr double kPi = std::numbers::pi;
    Eigen::Matrix<double, 9, 3> out = Eigen::Matrix<double, 9, 3>::Zero();
    out.row(0) = kY0 * 2 * kPi * (1 + 1 / albedo) * mean.transpose();
    out.row(2) = kY1 * kPi * (1 / albedo - 1) * mean.transpose();
    return out;
}

float luminanceOf(const Eigen::Vector3f& rgb) {
    return rgb.dot(Eigen::Vector3f(0.2126F, 0.7152F, 0.0722F));
}

std::size_t texelOf(const Eigen::Vector3f& direction) {
    constexpr float kTurn = 2 * std::numbers::pi_v<float>;
    const float u = std::atan2(direction.y(), direction.x()) / kTurn + 0.5F,
                v = std::acos(std::clamp(direction.z(), -1.0F, 1.0F)) / kTurn * 2;
    const auto index = [](float share, int count) {
        return std::clamp(static_cast<int>(share * static_cast<float>(count)), 0, count - 1);
    };
    return static_cast<std::size_t>(index(v, kMap.height)) * kMap.width + index(u, kMap.width);
}

Eigen::Vector3f directionOf(std::size_t texel) {
    const std::size_t row = texel / kMap.width, column = texel % kMap.width;
    return environmentDirection((static_cast<float>(column) + 0.5F) / kMap.width,
                                (static_cast<float>(row) + 0.5F) / kMap.height);
}

double solidAngleOf(std::size_t texel) {
    const double step = std::numbers::pi / kMap.height;
    const std::size_t row = texel / kMap.width;
    const double top = static_cast<double>(row) * step;
    return 2 * std::numbers::pi / kMap.width * (std::cos(top) - std::cos(top + step));
}

bool isFinite(const RigidTransform& T) {
    return T.rotation.coeffs().allFinite() && T.translation.allFinite();
}

LightEstimate estimateOf(const SphericalLight& radiance) {
    LightEstimate out{radiance};
    const Eigen::Vector3f linear(luminanceOf(radiance.row(3)), luminanceOf(radiance.row(1)),
                                 luminanceOf(radiance.row(2)));
    const float length = linear.norm(), level = luminanceOf(radiance.row(0));
    if (length > 0) out.mainDirection = linear / length;
    // If all light comes from one direction, the norm of the linear coefficients is sqrt(3) times
    // the constant coefficient.
    if (level > 0) out.directionality = std::min(length / level * kY0 / kY1, 1.0F);
    return out;
}

/// Returns a sun that represents a part of the light. The part grows with the directionality of the
/// light. Empty if the light is hardly directional, or if its main direction is near or below the
/// horizon.
std::optional<Sun> sunOf(const LightEstimate& estimate) {
    constexpr float kLeastDirectionality = 0.12F, kLeastElevation = 0.2F, kSoftness = 0.12F;
    if (!(estimate.directionality > kLeastDirectionality) ||
        !(estimate.mainDirection.z() > kLeastElevation))
        return std::nullopt;
    const Eigen::Vector3f& d = estimate.mainDirection;
    const Eigen::Vector3f along =
        (estimate.radiance.row(3) * d.x() + estimate.radiance.row(1) * d.y() +
         estimate.radiance.row(2) * d.z())
            .transpose();
    return Sun{d, (along / kY1 * estimate.directionality).cwiseMax(0.0F), kSoftness};
}

}  // namespace

LightEstimator::LightEstimator(const LightEstimatorOptions& options)
    : options_(options), map_(static_cast<std::size_t>(kMap.width) * kMap.height) {
    if (!(options.smoothingS > 0) || !(options.memoryS > 0) ||
        !(options.surfaceAlbedo > 0 && options.surfaceAlbedo <= 1))
        throw std::invalid_argument("light estimate: smoothingS and memoryS must be above 0, and "
                                    "surfaceAlbedo must be above 0 and at most 1");
}

bool LightEstimator::add(const ImageView& frame, const CameraModel& camera,
                         const RigidTransform& T_world_camera, Timestamp time) {
    requireSound(frame, "frame");
    if (!isFinite(T_world_camera) || (last_ && !(time > *last_))) return false;
    seenRadiance(frame, camera, T_world_camera, frame_);
    std::vector<Eigen::Vector4f> sums(map_.size(), Eigen::Vector4f::Zero());
    Eigen::Vector4f all = Eigen::Vector4f::Zero();
    for (const SeenRadiance& seen : frame_) {
        Eigen::Vector4f part;
        part << seen.radiance * seen.solidAngle, seen.solidAngle;
        sums[texelOf(seen.direction)] += part;
        all += part;
    }
    // A black picture is ignored. The lens is probably covered.
    constexpr float kBlack = 0.002F;
    if (!(all.head<3>().maxCoeff() > kBlack * all.w())) return false;
    for (std::size_t i = 0; i < map_.size(); ++i) {
        if (!(sums[i].w() > 0)) continue;
        Seen& seen = map_[i];
        const double kept =
            seen.last ? std::exp(-secondsBetween(*seen.last, time) / options_.smoothingS) : 0;
        const Eigen::Vector3f now = sums[i].head<3>() / sums[i].w();
        seen = {now + static_cast<float>(kept) * (seen.radiance - now), time};
    }
    last_ = time;
    return true;
}

std::optional<LightEstimate> LightEstimator::estimate() const {
    if (!last_) return std::nullopt;
    const Eigen::Vector<double, 9> prior = priorInformation();
    Eigen::Matrix<double, 9, 9> left = prior.asDiagonal();
    Eigen::Matrix<double, 9, 3> right = Eigen::Matrix<double, 9, 3>::Zero();
    Eigen::Vector3d light = Eigen::Vector3d::Zero();
    double angle = 0;
    for (std::size_t i = 0; i < map_.size(); ++i) {
        if (!map_[i].last) continue;
        const double weight =
            solidAngleOf(i) * std::exp(-secondsBetween(*map_[i].last, *last_) / options_.memoryS);
        const Eigen::Vector<double, 9> y = harmonicsAt(directionOf(i)).cast<double>();
        const Eigen::Vector3d radiance = map_[i].radiance.cast<double>();
        left.noalias() += weight * y * y.transpose();
        right.noalias() += weight * y * radiance.transpose();
        light += weight * radiance;
        angle += weight;
    }
    right += prior.asDiagonal() * priorLight(light / angle, options_.surfaceAlbedo);
    return estimateOf(left.ldlt().solve(right).cast<float>());
}

Lighting lightingOf(const LightEstimate& estimate) {
    const std::optional<Sun> sun = sunOf(estimate);
    SphericalLight rest = estimate.radiance;
    if (sun) rest -= harmonicsAt(sun->towards) * sun->irradiance.transpose();
    const auto radiance = [&](const Eigen::Vector3f& direction) -> Eigen::Vector3f {
        // The sum of nine harmonics may be negative opposite to a lamp.
        return radianceOf(rest, direction).cwiseMax(0.0F);
    };
    return {std::make_shared<const Environment>(environmentOf(kMap, radiance)), sun};
}

}  // namespace mfar
