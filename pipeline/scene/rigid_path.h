#pragma once

#include "base/geometry.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace mfar {

/// A value that changes over time, as a sampler of a glTF 2.0 animation gives it (appendix C).
struct MotionTrack {
    enum class Between : unsigned char { Step, Linear, CubicSpline };

    Between between = Between::Linear;
    std::vector<double> times;  ///< [s], increasing; empty: the value does not change
    /// One value for each time: a translation (x, y, z, 0) [m] or a unit quaternion (x, y, z, w).
    /// CubicSpline has three: the tangent [1/s] before the time, the value, and the tangent after.
    std::vector<Eigen::Vector4d> values;

    /// The first value holds before the first time, the last value after the last time.
    [[nodiscard]] Eigen::Vector3d translationAt(double seconds) const;
    /// Linear turns at a constant rate on the shorter way; CubicSpline is normalised.
    [[nodiscard]] Eigen::Quaterniond rotationAt(double seconds) const;
    [[nodiscard]] MotionTrack scaled(double scale) const;
};

/// The pose of a rigid part that moves on a closed loop in time: a chain of joints, from the
/// outermost to the part's own.
struct RigidPath {
    struct Joint {
        RigidTransform T_parent_joint;  ///< does not change; parent: the joint before
        RigidTransform rest;            ///< values of tracks without keyframes
        MotionTrack translation, rotation;
    };
    std::vector<Joint> joints;
    double length = 0;  ///< time after which the motion repeats [s]; 0: always the pose at time 0

    /// Returns T_model_part at this time.
    [[nodiscard]] RigidTransform at(double seconds) const;

    /// Returns the path T_world_part of a part of a model that is first scaled, then placed in the
    /// world.
    [[nodiscard]] RigidPath placed(const RigidTransform& T_world_model, double scale) const;
};

}  // namespace mfar
