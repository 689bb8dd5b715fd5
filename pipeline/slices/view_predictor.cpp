#include "pipeline/slices/view_predictor.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace mfar {
namespace {

// Time over which the velocity is measured [s]. It averages out the noise of poses from tags, but
// follows the motion of a hand.
constexpr double kWindow = 0.1;
constexpr double kLongestGap = 0.5;

}  // namespace

ViewPredictor::ViewPredictor(const PredictionLimits& limits) : limits_(limits) {
    if (!(limits.seconds >= 0 && limits.turnDegrees >= 0) || !std::isfinite(limits.seconds) ||
        !std::isfinite(limits.turnDegrees))
        throw std::invalid_argument(
            "path tracer: the limits of the view prediction must be finite and not negative");
}

const ViewPredictor::Entry& ViewPredictor::back(std::size_t steps) const {
    return entries_[(added_ - 1 - steps) % entries_.size()];
}

void ViewPredictor::add(const RigidTransform& T_world_camera, Timestamp time) {
    if (added_ > 0) {
        const double gap = secondsBetween(back(0).time, time);
        if (!(gap > 0 && gap < kLongestGap)) added_ = 0;
    }
    entries_[added_++ % entries_.size()] = {time, T_world_camera};
}

Vector6 ViewPredictor::rate() const {
    const std::size_t known = std::min(added_, entries_.size());
    if (known < 2) return Vector6::Zero();
    std::size_t steps = 1;
    const auto age = [&](std::size_t i) { return secondsBetween(back(i).time, back(0).time); };
    while (steps + 1 < known && age(steps + 1) <= kWindow)
        ++steps;
    const RigidTransform motion = back(steps).T_world_camera.inverse() * back(0).T_world_camera;
    return logarithm(motion) / age(steps);
}

RigidTransform ViewPredictor::predict(double seconds, double distance) const {
    if (added_ == 0) return {};
    Vector6 motion = rate() * std::clamp(seconds, 0.0, limits_.seconds);
    const double turn = limits_.turnDegrees * std::numbers::pi / 180;
    const double way = std::max(distance, 0.0) * turn;
    const double turned = motion.head<3>().norm(), moved = motion.tail<3>().norm();
    if (turned > turn) motion *= turn / turned;
    if (moved > way) motion *= std::min(1.0, way / motion.tail<3>().norm());
    return back(0).T_world_camera * exponential(motion);
}

}  // namespace mfar
