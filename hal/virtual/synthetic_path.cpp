#include "hal/virtual/synthetic_hash.h"
#include "hal/virtual/synthetic_scene.h"

#include <array>
#include <cmath>
#include <numbers>

namespace mfar::synthetic {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Returns a smooth random movement with mean 0 and an amplitude of about 1: a sum of sines with
/// different frequencies [Hz]. Fast sines are weak, as in the tremor of a hand.
double wobble(std::uint64_t seed, int channel, double t) {
    constexpr std::array<double, 5> kFrequency{0.31, 0.73, 1.57, 3.13, 5.71};
    constexpr std::array<double, 5> kWeight{0.55, 0.30, 0.20, 0.07, 0.03};
    double sum = 0;
    for (int i = 0; i < 5; ++i) {
        const double phase = hashUnit(hash(seed, channel, i)) * 2 * std::numbers::pi;
        const double detune = 0.9 + 0.2 * hashUnit(hash(seed, channel, i + 16));
        sum += kWeight[i] * std::sin(2 * std::numbers::pi * kFrequency[i] * detune * t + phase);
    }
    return sum;
}

RigidTransform lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
    const Eigen::Vector3d z = (target - eye).normalized();
    const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
    Eigen::Matrix3d r;
    r << x, z.cross(x), z;
    return {Eigen::Quaterniond(r), eye};
}

Eigen::Quaterniond tilt(double pitch, double yaw, double roll) {
    return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY()) *
           Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitX()) *
           Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ());
}

RigidTransform shake(std::uint64_t seed, double t, double amount) {
    const double metres = 0.005 * amount, angle = 1.1 * kDegree * amount;
    return {
        tilt(angle * wobble(seed, 3, t), angle * wobble(seed, 4, t),
             0.5 * angle * wobble(seed, 5, t)),
        {metres * wobble(seed, 0, t), metres * wobble(seed, 1, t), metres * wobble(seed, 2, t)}};
}

/// Returns the pose at time t of a camera that a person moves around the world's target for a
/// calibration: near and far, from all sides, rotated, and with the target in every part of the
/// picture.
RigidTransform survey(const World& world, double t) {
    const auto swing = [t](double amplitude, double period, double phase) {
        return amplitude * std::sin(2 * std::numbers::pi * (t / period + phase));
    };
    const Eigen::Quaterniond around =
        Eigen::AngleAxisd(swing(34 * kDegree, 5.3, 0), Eigen::Vector3d::UnitZ()) *
        Eigen::AngleAxisd(swing(26 * kDegree, 3.7, 0.2), Eigen::Vector3d::UnitX());
    const double distance = 1.05 + swing(0.3, 7.1, 0.6);
    const Eigen::Vector3d arm = around * (world.eye - world.target) * distance;
    const Eigen::Vector3d aside{swing(0.13, 2.9, 0.1), 0, swing(0.12, 2.3, 0.4)};
    return lookAt(world.target + arm, world.target + aside) *
           RigidTransform{tilt(0, 0, swing(25 * kDegree, 6.1, 0.3)), Eigen::Vector3d::Zero()};
}

}  // namespace

RigidTransform cameraPose(const World& world, Path path, std::uint64_t seed, double t) {
    RigidTransform base = lookAt(world.eye, world.target);
    const double turn = 2 * std::numbers::pi * t;
    switch (path) {
    case Path::Handheld: return base * shake(seed, t, 1);
    case Path::Pan:
        return base *
               RigidTransform{tilt(0, 10 * kDegree * std::sin(turn / 9), 0),
                              Eigen::Vector3d::Zero()} *
               shake(seed, t, 0.15);
    case Path::Orbit: {
        const Eigen::Quaterniond around(
            Eigen::AngleAxisd(14 * kDegree * std::sin(turn / 11), Eigen::Vector3d::UnitZ()));
        const Eigen::Vector3d arm = world.eye - world.target;
        return lookAt(world.target + around * arm, world.target) * shake(seed, t, 0.15);
    }
    case Path::Forward: {
        const double reach = 0.15 * (world.target - world.eye).norm();
        const Eigen::Vector3d ahead{0, 0, reach * 0.5 * (1 - std::cos(turn / 7))};
        return base * RigidTransform{Eigen::Quaterniond::Identity(), ahead} * shake(seed, t, 0.15);
    }
    case Path::Rotate:
        return base * RigidTransform{tilt(3 * kDegree * std::sin(turn / 5),
                                          6 * kDegree * std::sin(turn / 7 + 1),
                                          4 * kDegree * std::sin(turn / 6 + 2)),
                                     Eigen::Vector3d::Zero()};
    case Path::Survey: return survey(world, t) * shake(seed, t, 0.15);
    case Path::Rest: break;
    }
    return base;
}

StereoRig boardRig() {
    StereoRig rig;
    rig.video = {{640, 480}, 560.4, 560.9, 321.7, 237.6, {-0.115, 0.062, 0.0006, -0.0005, 0.0}};
    rig.still = {{2304, 1728}, 1962.0, 1963.5,
                 1158.2,       857.4,  {-0.072, 0.031, -0.0004, 0.0007, 0.0}};
    const Eigen::Quaterniond skew = tilt(0.28 * kDegree, -0.35 * kDegree, 0.22 * kDegree);
    const Eigen::Vector3d stillInVideo = 0.014 * Eigen::Vector3d(0.9965, 0.07, 0.045).normalized();
    rig.T_still_video = {skew, -(skew * stillInVideo)};
    return rig;
}

StereoRig boardRig(Size video, Size still) {
    const StereoRig rig = boardRig();
    return {rig.video.scaledTo(video), rig.still.scaledTo(still), rig.T_still_video};
}

}  // namespace mfar::synthetic
