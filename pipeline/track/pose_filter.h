#pragma once

#include "base/geometry.h"
#include "base/se3.h"

#include <Eigen/Core>

#include <chrono>
#include <optional>

namespace mfar {

struct PoseFilterOptions {
    /// In the constant-velocity model, accelerations are white noise. Lengths are relative to the
    /// distance from the tags, because the errors of a pose are proportional to it.
    double angularAcceleration = 0.4;  ///< [rad/s^2 per root Hz]
    double linearAcceleration = 0.4;   ///< [distances/s^2 per root Hz]
    /// Largest squared Mahalanobis distance (6 degrees of freedom) of a pose from the prediction.
    /// Above it, the pose is an outlier.
    double gate = 50;
    /// Number of consecutive outliers that restart the filter if they agree with each other.
    int jumpFrames = 3;
    /// Predictions end after this time or after bridgeFrames frames without an accepted pose.
    std::chrono::nanoseconds bridge = std::chrono::milliseconds(400);
    int bridgeFrames = 12;
};

/// Constant-velocity Kalman filter on SE(3). The camera is assumed to keep its rates of rotation
/// and translation in its own coordinates. The error state has 12 dimensions in the camera's
/// coordinates: errors of the pose (rotation, translation) and of the twist (the rates). Only one
/// thread at a time may use it.
class PoseFilter {
public:
    explicit PoseFilter(const PoseFilterOptions& options = {});

    enum class Outcome {
        Started,  ///< the filter starts: first pose, or first after too long a gap or a step back
                  ///< in time
        Accepted,
        Rejected,
        Jumped  ///< several outliers agreed with each other, and the filter restarted from them
    };
    /// Adds a measured pose. `distance` is the distance of the camera from the measured tags, in
    /// the pose's unit of length.
    Outcome update(const Pose& measured, double distance);
    void missed();
    void reset();

    /// Returns the pose at time t, with tags = 0. Returns nothing before the first pose, more than
    /// `bridge` before or after the last accepted pose, or after bridgeFrames frames without an
    /// accepted pose.
    [[nodiscard]] std::optional<Pose> predict(Timestamp t) const;

private:
    using Matrix12 = Eigen::Matrix<double, 12, 12>;
    struct State {
        Timestamp time;
        RigidTransform T_world_video;
        Vector6 twist = Vector6::Zero();
        Matrix12 P = Matrix12::Zero();
        double distance = 1;
        int accepted = 1;
    };

    [[nodiscard]] State started(const Pose& measured, double distance) const;
    [[nodiscard]] State propagated(const State& from, Timestamp to) const;
    /// Returns false and changes nothing if the pose is an outlier.
    [[nodiscard]] bool correct(State& state, const Pose& measured, double distance) const;
    [[nodiscard]] bool reaches(const State& state, Timestamp t) const;

    PoseFilterOptions options_;
    std::optional<State> state_;
    std::optional<State> rival_;  ///< a second state, which is updated with the outliers
    int missed_ = 0;
};

}  // namespace mfar
