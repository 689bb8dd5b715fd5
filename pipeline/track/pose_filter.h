#pragma once

#include "base/geometry.h"
#include "base/se3.h"

#include <Eigen/Core>

#include <chrono>
#include <optional>

namespace mfar {

struct PoseFilterOptions {
    /// White acceleration that the constant velocity leaves to chance. Lengths are in distances to
    /// the tags, as the errors of a pose are, so that the unit of length does not matter.
    double angularAcceleration = 0.4;  ///< [rad/s^2 per root Hz]
    double linearAcceleration = 0.4;   ///< [distances/s^2 per root Hz]
    double gate = 50;  ///< squared Mahalanobis distance from which a pose is an outlier, 6 degrees
                       ///< of freedom
    int jumpFrames = 3;  ///< outliers in a row that agree with each other make a new start
    std::chrono::nanoseconds bridge = std::chrono::milliseconds(400);  ///< longest prediction
    int bridgeFrames = 12;  ///< frames without an accepted pose until there is none
};

/// Constant-velocity Kalman filter on SE(3): the camera keeps turning and moving at its rate in its
/// own frame. Error state of 12: motion of the pose (rotation, translation) and of the twist, both
/// in the camera's frame. One thread at a time.
class PoseFilter {
public:
    /// Throws std::invalid_argument for options that are not positive or not finite.
    explicit PoseFilter(const PoseFilterOptions& options = {});

    enum class Outcome {
        Started,   ///< the first pose, or the first after too long a gap or a step back in time
        Accepted,  ///< blended with the prediction
        Rejected,  ///< an outlier: the prediction stands
        Jumped     ///< the outliers agree with each other: they are the truth now
    };
    /// A measured pose with its time and covariance. `distance`: of the camera to what it was
    /// measured from, same unit as the translation.
    Outcome update(const Pose& measured, double distance);
    /// A frame in which no pose was measured.
    void missed();
    void reset();

    /// Pose and covariance at t, tags = 0; t may lie `bridge` before or after the last accepted
    /// pose. Nothing beyond, after bridgeFrames frames without one, or before the first.
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
    /// False, and nothing changed, when the pose is an outlier.
    [[nodiscard]] bool correct(State& state, const Pose& measured, double distance) const;
    [[nodiscard]] bool reaches(const State& state, Timestamp t) const;

    PoseFilterOptions options_;
    std::optional<State> state_;
    std::optional<State> rival_;  ///< fed by the outliers
    int missed_ = 0;
};

}  // namespace mfar
