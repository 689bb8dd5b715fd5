#include "pipeline/scene/rigid_path.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

/// Position of a time between two keyframes.
struct Span {
    std::size_t from = 0, to = 0;
    double share = 0;     ///< [0, 1)
    double duration = 0;  ///< [s]
};

Span spanAt(const std::vector<double>& times, double seconds) {
    const auto after = std::ranges::upper_bound(times, seconds);
    if (after == times.begin()) return {};
    const auto from = static_cast<std::size_t>(after - times.begin()) - 1;
    if (after == times.end()) return {from, from, 0, 0};
    const double duration = times[from + 1] - times[from];
    return {from, from + 1, (seconds - times[from]) / duration, duration};
}

/// The cubic Hermite spline of glTF 2.0, appendix C.5.
Eigen::Vector4d onSpline(const std::vector<Eigen::Vector4d>& values, const Span& span) {
    const double t = span.share, t2 = t * t, t3 = t2 * t;
    const auto part = [&](std::size_t key, std::size_t which) -> const Eigen::Vector4d& {
        return values[3 * key + which];
    };
    return (2 * t3 - 3 * t2 + 1) * part(span.from, 1) +
           span.duration * (t3 - 2 * t2 + t) * part(span.from, 2) +
           (3 * t2 - 2 * t3) * part(span.to, 1) + span.duration * (t3 - t2) * part(span.to, 0);
}

}  // namespace

MotionTrack MotionTrack::scaled(double scale) const {
    MotionTrack out = *this;
    for (Eigen::Vector4d& value : out.values)
        value *= scale;
    return out;
}

bool MotionTrack::isConstant() const {
    if (times.size() <= 1) return true;
    // A spline between equal values may leave them, because of its tangents.
    return between != Between::CubicSpline &&
           std::ranges::all_of(values, [&](const auto& value) { return value == values[0]; });
}

Eigen::Vector3d MotionTrack::translationAt(double seconds) const {
    const Span span = spanAt(times, seconds);
    if (between == Between::CubicSpline) return onSpline(values, span).head<3>();
    const double share = between == Between::Linear ? span.share : 0;
    return ((1 - share) * values[span.from] + share * values[span.to]).head<3>();
}

Eigen::Quaterniond MotionTrack::rotationAt(double seconds) const {
    const Span span = spanAt(times, seconds);
    if (between == Between::CubicSpline) {
        const Eigen::Vector4d sum = onSpline(values, span);
        const bool known = sum.norm() > 1e-9;  // a spline may pass through 0
        return Eigen::Quaterniond(known ? sum : values[3 * span.from + 1]).normalized();
    }
    const Eigen::Quaterniond from(values[span.from]), to(values[span.to]);
    return between == Between::Linear ? from.slerp(span.share, to).normalized() : from;
}

RigidTransform RigidPath::at(double seconds) const {
    const double turn = length > 0 ? std::fmod(seconds, length) : 0;
    const double now = turn < 0 ? turn + length : turn;
    RigidTransform T;
    for (const Joint& joint : joints) {
        RigidTransform moved = joint.rest;
        if (!joint.translation.times.empty())
            moved.translation = joint.translation.translationAt(now);
        if (!joint.rotation.times.empty()) moved.rotation = joint.rotation.rotationAt(now);
        T = T * joint.T_parent_joint * moved;
    }
    return T;
}

RigidPath RigidPath::placed(const RigidTransform& T_world_model, double scale) const {
    RigidPath out = *this;
    for (Joint& joint : out.joints) {
        joint.T_parent_joint.translation *= scale;
        joint.rest.translation *= scale;
        joint.translation = joint.translation.scaled(scale);
    }
    if (!out.joints.empty())
        out.joints.front().T_parent_joint = T_world_model * out.joints.front().T_parent_joint;
    return out;
}

}  // namespace mfar
