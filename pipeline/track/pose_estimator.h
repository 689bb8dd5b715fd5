#pragma once

#include "pipeline/track/pose_filter.h"
#include "pipeline/track/tag_pose.h"

#include <optional>
#include <span>

namespace mfar {

struct PlanarChoiceOptions {
    double errorSigma = 0.25;  ///< assumed standard deviation of a corner's coordinates [px]
    /// The choice changes to the other solution if the evidence exceeds this. The evidence is the
    /// log likelihood ratio of the corners for both solutions, summed over frames.
    double threshold = 12;
    double memory = 0.95;  ///< factor of the earlier evidence in each new frame, [0, 1)
};

/// Chooses one of the two poses from which a plane of tags looks nearly the same. The pose nearer
/// to the predicted motion is kept until the other pose explains the corners significantly better,
/// in one frame or over many frames. So noise does not flip the pose when the plane is seen from
/// straight ahead, and a wrong first choice is corrected.
class PlanarChoice {
public:
    explicit PlanarChoice(const PlanarChoiceOptions& options = {});

    /// Returns a reference into `poses`. Without a prediction, chooses the pose with the smaller
    /// error.
    [[nodiscard]] const CameraPose& choose(const CameraPoses& poses,
                                           const std::optional<RigidTransform>& predicted);
    [[nodiscard]] bool flipped() const { return flipped_; }

private:
    PlanarChoiceOptions options_;
    double evidence_ = 0;
    bool flipped_ = false;
};

struct PoseEstimatorOptions {
    TagPoseOptions tagPose;
    PlanarChoiceOptions choice;
    PoseFilterOptions filter;
};

/// Estimates the camera's motion from the tags in each video frame: computes both solutions of the
/// pose, chooses one, and filters it. Only one thread at a time may use it.
class PoseEstimator {
public:
    explicit PoseEstimator(const PoseEstimatorOptions& options = {});

    /// Returns the filtered pose at the frame's time. If no tag is visible or the measured pose is
    /// an outlier, returns the predicted pose (tags = 0), and nothing once the filter no longer
    /// predicts.
    std::optional<Pose> update(std::span<const TagObservation> tags, const CameraModel& camera,
                               Timestamp time);
    [[nodiscard]] const std::optional<Pose>& raw() const { return raw_; }
    [[nodiscard]] std::optional<Pose> predict(Timestamp t) const { return filter_.predict(t); }
    /// Measures the pose of the video camera at the time of a picture that is not a video frame.
    /// The filter's prediction selects one of the two solutions. The pose is not filtered, and the
    /// filter does not change.
    [[nodiscard]] std::optional<Pose> measure(std::span<const TagObservation> tags,
                                              const CameraModel& camera,
                                              const RigidTransform& T_camera_video,
                                              Timestamp time) const;

    [[nodiscard]] int flips() const { return flips_; }
    [[nodiscard]] int rejected() const { return rejected_; }
    /// Number of restarts of the filter after outliers that agreed with each other.
    [[nodiscard]] int jumps() const { return jumps_; }

private:
    PoseEstimatorOptions options_;
    PlanarChoice choice_;
    PoseFilter filter_;
    std::optional<Pose> raw_;
    int flips_ = 0, rejected_ = 0, jumps_ = 0;
};

}  // namespace mfar
