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
    std::vector<double> times;  ///< [s], strictly increasing; empty: the value does not change
    /// One value for each time: a translation (x, y, z, 0) [m] or a unit quaternion (x, y, z, w).
    /// CubicSpline has three entries for each time: tangent before the time, value, and tangent
    /// after the time. A tangent is the change of the value per second.
    std::vector<Eigen::Vector4d> values;

    /// Returns the first value before the first time, and the last value after the last time.
    [[nodiscard]] Eigen::Vector3d translationAt(double seconds) const;
    /// Between::Linear gives a rotation at a constant rate by the smaller angle. A quaternion from
    /// Between::CubicSpline is normalised.
    [[nodiscard]] Eigen::Quaterniond rotationAt(double seconds) const;
    [[nodiscard]] MotionTrack scaled(double scale) const;
    /// True if the value is the same at all times. A spline with several times counts as changing.
    [[nodiscard]] bool isConstant() const;

    bool operator==(const MotionTrack&) const = default;
};

/// The pose of a rigid part over time; the motion repeats. The part hangs on a chain of moving
/// joints, the outermost first, the part's own joint last.
struct RigidPath {
    struct Joint {
        RigidTransform T_parent_joint;  ///< constant offset from the joint before
        RigidTransform rest;            ///< replaces a track without keyframes
        MotionTrack translation, rotation;

        bool operator==(const Joint&) const = default;
    };
    std::vector<Joint> joints;
    double length = 0;  ///< time after which the motion repeats [s]; 0: always the pose at time 0

    /// Returns T_model_part at this time.
    [[nodiscard]] RigidTransform at(double seconds) const;

    /// Returns the path T_world_part of a part of a model that is first scaled, then placed in the
    /// world.
    [[nodiscard]] RigidPath placed(const RigidTransform& T_world_model, double scale) const;

    bool operator==(const RigidPath&) const = default;
};

}  // namespace mfar
