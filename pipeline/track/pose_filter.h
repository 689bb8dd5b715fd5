#pragma once

#include "base/geometry.h"
#include "base/se3.h"

#include <Eigen/Core>

#include <chrono>
#include <optional>

namespace mfar {

struct PoseFilterOptions {
    /// Strength of the accelerations, which are white noise in the constant-velocity model. Lengths
    /// are relative to the camera's distance from the tags, because the errors of a pose are
    /// proportional to this distance.
    double angularAcceleration = 0.4;  ///< [rad/s^2 per root Hz]
    double linearAcceleration = 0.4;   ///< [distances/s^2 per root Hz]
    /// A pose is an outlier if its squared Mahalanobis distance from the prediction (6 degrees of
    /// freedom) is larger than this.
    double gate = 50;
    /// The filter restarts after this number of outliers that agree with each other, without an
    /// accepted pose between them. Frames without a pose may lie between them.
    int jumpFrames = 3;
    /// Limits of predictions without an accepted pose: this time, and bridgeFrames frames. If one
    /// of them is exceeded, there is no prediction.
    std::chrono::nanoseconds bridge = std::chrono::milliseconds(400);
    int bridgeFrames = 12;
};

/// Constant-velocity Kalman filter on SE(3). The camera is assumed to keep its rates of rotation
/// and translation, in its own coordinates. The state's error has 12 dimensions in the camera's
/// coordinates: 6 for the pose (rotation, translation), and 6 for the rates of both (the twist).
/// Only one thread at a time may use the filter.
class PoseFilter {
public:
    explicit PoseFilter(const PoseFilterOptions& options = {});

    enum class Outcome {
        /// The filter (re)started with this pose, because there was no earlier pose, predictions
        /// had ended (see PoseFilterOptions::bridge), or this pose is not later than the last one.
        Started,
        Accepted,
        Rejected,  ///< an outlier, or the pose, its covariance or `distance` is invalid
        Jumped     ///< the filter restarted, because several outliers agreed with each other
    };
    /// Adds a measured pose. `distance` is the distance of the camera from the measured tags, in
    /// the pose's unit of length.
    Outcome update(const Pose& measured, double distance);
    /// Reports a frame without a measured pose.
    void missed();
    void reset();

    /// Returns the predicted pose at time t, with tags = 0. Returns nothing in four cases: there
    /// was no pose yet; t is more than `bridge` before or after the last accepted pose; more than
    /// bridgeFrames frames in a row had no accepted pose; or double precision is not enough for
    /// the prediction.
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
    std::optional<State> rival_;  ///< a second filter state, which is updated with the outliers
    int missed_ = 0;
};

}  // namespace mfar
