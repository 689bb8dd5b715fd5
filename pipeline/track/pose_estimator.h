#pragma once

#include "pipeline/track/pose_filter.h"
#include "pipeline/track/tag_pose.h"

#include <optional>
#include <span>

namespace mfar {

struct PlanarChoiceOptions {
    double errorSigma = 0.25;  ///< assumed standard deviation of a corner's coordinates [px]
    /// If the evidence for the other solution exceeds this, the choice changes to it. The evidence
    /// is the log likelihood ratio of the corners for the two solutions, summed over frames.
    double threshold = 12;
    double memory = 0.95;  ///< in each frame, the earlier evidence is multiplied by this, [0, 1)
};

/// Chooses one of the two poses from which a plane of tags looks nearly the same. It keeps to the
/// pose that is nearer to the predicted orientation. It changes to the other pose when the corners
/// fit the other one significantly better, in one frame or over many frames. Thus, noise does not
/// flip the pose when the plane is seen from straight ahead, but a wrong first choice is corrected.
class PlanarChoice {
public:
    explicit PlanarChoice(const PlanarChoiceOptions& options = {});

    /// Returns one of the two `poses`, as a reference into the argument. Without a prediction, it
    /// is the pose with the smaller error.
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

/// Estimates the camera's motion from the tags in each video frame. Computes both solutions of the
/// pose, chooses one of them, and filters it. Only one thread at a time may use it.
class PoseEstimator {
public:
    explicit PoseEstimator(const PoseEstimatorOptions& options = {});

    /// Returns the filtered pose at the frame's time. If no tag is usable, or if the measured pose
    /// is an outlier, returns the filter's prediction (tags = 0). Returns nothing if the filter
    /// does not predict any more.
    std::optional<Pose> update(std::span<const TagObservation> tags, const CameraModel& camera,
                               Timestamp time);
    /// Unfiltered pose of the last update(), even if it is an outlier. Empty if no tag was usable.
    [[nodiscard]] const std::optional<Pose>& raw() const { return raw_; }
    [[nodiscard]] std::optional<Pose> predict(Timestamp t) const { return filter_.predict(t); }
    /// Measures the pose of the video camera at the time of a picture that is not a video frame.
    /// The filter's prediction helps to choose one of the two poses from which the tags look nearly
    /// the same. The result is not filtered, and does not change the filter.
    [[nodiscard]] std::optional<Pose> measure(std::span<const TagObservation> tags,
                                              const CameraModel& camera,
                                              const RigidTransform& T_camera_video,
                                              Timestamp time) const;

    [[nodiscard]] int flips() const { return flips_; }
    [[nodiscard]] int rejected() const { return rejected_; }
    /// Number of times that the filter restarted because several outliers agreed with each other.
    [[nodiscard]] int jumps() const { return jumps_; }

private:
    PoseEstimatorOptions options_;
    PlanarChoice choice_;
    PoseFilter filter_;
    std::optional<Pose> raw_;
    int flips_ = 0, rejected_ = 0, jumps_ = 0;
};

}  // namespace mfar
