#pragma once

#include "base/geometry.h"
#include "base/se3.h"

#include <Eigen/Core>

#include <chrono>
#include <optional>

namespace mfar {

struct PoseFilterOptions {
    /// White-noise acceleration of the constant-velocity model. Lengths are in distances to the
    /// tags, because a pose's errors are proportional to these; the unit of length is irrelevant.
    double angularAcceleration = 0.4;  ///< [rad/s^2 per root Hz]
    double linearAcceleration = 0.4;   ///< [distances/s^2 per root Hz]
    double gate = 50;  ///< squared Mahalanobis distance above which a pose is an outlier, 6 degrees
                       ///< of freedom
    int jumpFrames = 3;  ///< consecutive consistent outliers that restart the filter
    std::chrono::nanoseconds bridge = std::chrono::milliseconds(400);  ///< longest prediction
    int bridgeFrames = 12;  ///< frames without an accepted pose after which predictions end
};

/// Constant-velocity Kalman filter on SE(3): the camera keeps its rates of rotation and translation
/// in its own frame. Error state of 12: motion of the pose (rotation, translation) and of the
/// twist, both in the camera's frame. One thread at a time.
class PoseFilter {
public:
    /// Throws std::invalid_argument for options that are not positive or not finite.
    explicit PoseFilter(const PoseFilterOptions& options = {});

    enum class Outcome {
        Started,   ///< the first pose, or the first after too long a gap or after time went back
        Accepted,  ///< blended with the prediction
        Rejected,  ///< an outlier: the prediction is kept
        Jumped     ///< consistent outliers: the filter restarts from them
    };
    /// Adds a measured pose with its time and covariance. `distance`: from the camera to the
    /// measured tags, same unit as the translation.
    Outcome update(const Pose& measured, double distance);
    /// Reports a frame without a measured pose.
    void missed();
    void reset();

    /// Pose and covariance at t, tags = 0; t may lie `bridge` before or after the last accepted
    /// pose. Empty beyond that, after bridgeFrames frames without an accepted pose, or before the
    /// first.
    [[nodiscard]] std::optional<Pose> predict(Timestamp t) const;

private:
    using Matrix12 = Eigen::Matrix<double, 12, 12>;
    struct State {
        Timestamp time;
        RigidTransform T_world_video;
        Vector6 twist = Vector6::Zero();  ///< [rad/s, m/s]
        Matrix12 P = Matrix12::Zero();
        double distance = 1;
        int accepted = 1;
    };

    [[nodiscard]] State started(const Pose& measured, double distance) const;
    [[nodiscard]] State propagated(const State& from, Timestamp to) const;
    /// Returns false and changes nothing when the pose is an outlier.
    [[nodiscard]] bool correct(State& state, const Pose& measured, double distance) const;
    [[nodiscard]] bool reaches(const State& state, Timestamp t) const;

    PoseFilterOptions options_;
    std::optional<State> state_;
    std::optional<State> rival_;  ///< a second state, updated by the outliers
    int missed_ = 0;
};

}  // namespace mfar
