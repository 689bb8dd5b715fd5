#include "pipeline/track/pose_filter.h"

#include <Eigen/Dense>

#include <cmath>
#include <stdexcept>

namespace mfar {
namespace {

// When the filter starts, the rates of rotation [rad/s] and translation [distances/s] are unknown
// and have this standard deviation. (In a second, a tracked camera usually turns by less than one
// radian, and moves by less than its distance from the tags.)
constexpr double kStartRate = 1;

bool positive(double v) {
    return v > 0 && std::isfinite(v);
}

}  // namespace

PoseFilter::PoseFilter(const PoseFilterOptions& o) : options_(o) {
    if (!positive(o.angularAcceleration) || !positive(o.linearAcceleration) || !positive(o.gate) ||
        o.jumpFrames < 1 || o.bridge.count() < 0 || o.bridgeFrames < 0)
        throw std::invalid_argument(
            "pose filter: the accelerations, gate and jumpFrames must be positive, and bridge and "
            "bridgeFrames must not be negative");
}

PoseFilter::State PoseFilter::started(const Pose& measured, double distance) const {
    State out;
    out.time = measured.time;
    out.T_world_video = measured.T_world_video;
    out.distance = distance;
    out.P.topLeftCorner<6, 6>() = measured.covariance;
    out.P.diagonal().segment<3>(6).setConstant(kStartRate * kStartRate);
    out.P.diagonal().tail<3>().setConstant(kStartRate * kStartRate * distance * distance);
    return out;
}

PoseFilter::State PoseFilter::propagated(const State& from, Timestamp to) const {
    const double dt = secondsBetween(from.time, to), span = std::abs(dt);
    State out = from;
    out.time = to;
    const RigidTransform motion = exponential(dt * from.twist);
    out.T_world_video = from.T_world_video * motion;
    Matrix12 F = Matrix12::Identity();
    F.topLeftCorner<6, 6>() = adjoint(motion.inverse());
    F.topRightCorner<6, 6>() = dt * Matrix6::Identity();
    Vector6 q;
    const double angular = options_.angularAcceleration;
    const double linear = options_.linearAcceleration * from.distance;
    q << Eigen::Vector3d::Constant(angular * angular), Eigen::Vector3d::Constant(linear * linear);
    out.P = F * from.P * F.transpose();
    out.P.topLeftCorner<6, 6>().diagonal() += q * span * span * span / 3;
    out.P.bottomRightCorner<6, 6>().diagonal() += q * span;
    out.P.topRightCorner<6, 6>().diagonal() += q * dt * span / 2;
    out.P.bottomLeftCorner<6, 6>().diagonal() += q * dt * span / 2;
    return out;
}

bool PoseFilter::correct(State& state, const Pose& measured, double distance) const {
    State next = propagated(state, measured.time);
    const Vector6 innovation = logarithm(next.T_world_video.inverse() * measured.T_world_video);
    const Matrix6 S = next.P.topLeftCorner<6, 6>() + measured.covariance;
    const Eigen::LDLT<Matrix6> solver(S);
    if (!(innovation.dot(solver.solve(innovation)) <= options_.gate)) return false;
    const Eigen::Matrix<double, 12, 6> K = solver.solve(next.P.topRows<6>()).transpose();
    const Eigen::Matrix<double, 12, 1> x = K * innovation;
    if (!x.allFinite()) return false;
    Matrix12 keep = Matrix12::Identity();
    keep.leftCols<6>() -= K;
    next.P = keep * next.P * keep.transpose() + K * measured.covariance * K.transpose();
    next.P = 0.5 * (next.P + next.P.transpose()).eval();
    next.T_world_video = next.T_world_video * exponential(x.head<6>());
    next.twist += x.tail<6>();
    next.distance = distance;
    if (!next.P.allFinite() || !(next.P.diagonal().minCoeff() >= 0)) return false;
    ++next.accepted;
    state = next;
    return true;
}

bool PoseFilter::reaches(const State& state, Timestamp t) const {
    return std::abs(secondsBetween(state.time, t)) <=
           std::chrono::duration<double>(options_.bridge).count();
}

PoseFilter::Outcome PoseFilter::update(const Pose& told, double distance) {
    const auto sound = soundMotion(told.T_world_video);
    const bool usable = sound && told.covariance.allFinite() &&
                        told.covariance.diagonal().minCoeff() >= 0 && positive(distance);
    if (!usable) {
        missed();
        return Outcome::Rejected;
    }
    Pose measured = told;
    measured.T_world_video = *sound;
    if (!state_ || missed_ > options_.bridgeFrames || !reaches(*state_, measured.time) ||
        !(state_->time < measured.time)) {
        reset();
        state_ = started(measured, distance);
        return Outcome::Started;
    }
    if (correct(*state_, measured, distance)) {
        rival_.reset();
        missed_ = 0;
        return Outcome::Accepted;
    }
    if (!rival_ || !(rival_->time < measured.time) || !correct(*rival_, measured, distance))
        rival_ = started(measured, distance);
    if (rival_->accepted >= options_.jumpFrames) {
        state_ = rival_;
        rival_.reset();
        missed_ = 0;
        return Outcome::Jumped;
    }
    ++missed_;
    return Outcome::Rejected;
}

void PoseFilter::missed() {
    if (missed_ <= options_.bridgeFrames) ++missed_;
}

void PoseFilter::reset() {
    state_.reset();
    rival_.reset();
    missed_ = 0;
}

std::optional<Pose> PoseFilter::predict(Timestamp t) const {
    if (!state_ || missed_ > options_.bridgeFrames || !reaches(*state_, t)) return std::nullopt;
    const State at = propagated(*state_, t);
    // A covariance that is not finite, or has a negative variance, shows that double precision was
    // not enough. There is then no valid prediction.
    if (!isFinite(at.T_world_video) || !at.P.allFinite() || !(at.P.diagonal().minCoeff() >= 0))
        return std::nullopt;
    Pose out;
    out.time = t;
    out.T_world_video = at.T_world_video;
    out.covariance = at.P.topLeftCorner<6, 6>();
    return out;
}

}  // namespace mfar
