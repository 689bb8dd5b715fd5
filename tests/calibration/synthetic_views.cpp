#include "tests/calibration/synthetic_views.h"

#include "hal/virtual/synthetic_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace mfar::test {
namespace {

using calibration::Corner;
using calibration::SensorViews;
using calibration::Target;

constexpr double kRateHz = 30;

/// Pose of the target in the video camera at time t [s]: T_video_target. In the course of time, the
/// target is tilted to all sides, comes near and goes far, and reaches every part of the picture.
RigidTransform poseAt(const Target& target, const Motion& m, double t) {
    if (m.rests) {
        const double second = std::floor(t), s = std::max(0., (t - second - 0.8) / 0.2);
        t = second + s * s * (3 - 2 * s);
    }
    const auto swing = [t](double amplitude, double period, double phase) {
        return amplitude * std::sin(2 * std::numbers::pi * (t / period + phase));
    };
    using Eigen::AngleAxisd, Eigen::Vector3d;
    const Eigen::Quaterniond turn =
        AngleAxisd(swing(m.tilt, 5.3, 0), Vector3d::UnitY()) *
        AngleAxisd(std::numbers::pi + swing(m.tilt, 3.7, 0.2), Vector3d::UnitX()) *
        AngleAxisd(swing(m.tilt, 6.1, 0.3), Vector3d::UnitZ());
    const Vector3d middle = 0.5 * target.points[target.points.size() - 2];
    const Vector3d place{swing(m.aside, 2.9, 0.1), swing(m.aside, 2.3, 0.4),
                         0.65 * (1 + swing(m.distance, 7.1, 0.6))};
    return {turn, place - turn * middle};
}

std::vector<Corner> project(const Target& target, const CameraModel& camera,
                            const RigidTransform& T_camera_target, double noise,
                            std::mt19937& random) {
    std::normal_distribution<double> normal(0, 1);
    std::vector<Corner> out;
    for (std::size_t i = 0; i < target.points.size(); ++i) {
        const Eigen::Vector3d p = T_camera_target * target.points[i];
        const Eigen::Vector2d ray = p.head<2>() / p.z();
        if (!(p.z() > 0.05 && ray.norm() < 1)) continue;
        const Eigen::Vector2d pixel = camera.project(ray);
        if (!(pixel.x() > 5 && pixel.y() > 5 && pixel.x() < camera.size.width - 6 &&
              pixel.y() < camera.size.height - 6))
            continue;
        const double dx = noise * normal(random), dy = noise * normal(random);
        out.push_back({static_cast<int>(i), pixel + Eigen::Vector2d(dx, dy)});
    }
    return out;
}

}  // namespace

StereoRig trueRig() {
    return synthetic::boardRig();
}

StereoRig wideRig() {
    StereoRig rig = trueRig();
    rig.still = {{4608, 2592}, 2100, 2105, 2290, 1310, {-0.08, 0.01, 0.0005, -0.0003, 0}};
    return rig;
}

BothViews makeViews(const Target& target, const Motion& motion, const StereoRig& rig) {
    std::mt19937 random(static_cast<std::mt19937::result_type>(motion.seed));
    BothViews out{{rig.video.size, {}}, {rig.still.size, {}}};
    const auto time = [](double t) { return Timestamp::fromSeconds(100 + t); };
    for (double t = 0; t < motion.seconds; t += 1 / kRateHz)
        out.video.views.push_back(
            {time(t), project(target, rig.video, poseAt(target, motion, t), motion.noise, random)});
    for (double t = 0.4; t < motion.seconds - 0.4; t += 1 / motion.stillsHz + 0.0031) {
        const RigidTransform T = rig.T_still_video * poseAt(target, motion, t);
        out.still.views.push_back(
            {time(t - motion.offset), project(target, rig.still, T, motion.noise, random)});
    }
    return out;
}

}  // namespace mfar::test
