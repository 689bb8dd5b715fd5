#pragma once

#include "pipeline/track/pose_filter.h"
#include "pipeline/track/tag_pose.h"

#include <optional>
#include <span>

namespace mfar {

struct PlanarChoiceOptions {
    double errorSigma = 0.25;  ///< assumed noise of a corner's coordinates for evidence [px]
    /// Evidence at which the choice changes to the other solution: log likelihood ratio of the
    /// corners, summed over frames.
    double threshold = 12;
    double memory = 0.95;  ///< factor of the evidence from one frame to the next, [0, 1)
};

/// Decides between the two poses from which a plane of tags looks nearly the same. The pose nearer
/// to the predicted motion is kept until the other explains the corners, in one frame or over many,
/// better than chance permits. So noise does not flip the pose when the plane is seen from straight
/// ahead, where both errors are equal, and a wrong initial choice is corrected.
class PlanarChoice {
public:
    /// Throws std::invalid_argument for options out of their range.
    explicit PlanarChoice(const PlanarChoiceOptions& options = {});

    /// Returns a reference into `poses`. Without a prediction: the pose with the smaller error.
    [[nodiscard]] const CameraPose& choose(const CameraPoses& poses,
                                           const std::optional<RigidTransform>& predicted);
    /// True when the last choice changed to the pose farther from the prediction.
    [[nodiscard]] bool flipped() const { return flipped_; }

private:
    PlanarChoiceOptions options_;
    double evidence_ = 0;  ///< for the solution that is not chosen
    bool flipped_ = false;
};

struct PoseEstimatorOptions {
    TagPoseOptions tagPose;
    PlanarChoiceOptions choice;
    PoseFilterOptions filter;
};

/// Estimates the camera's motion from the tags of each video frame: solve, choose, filter. One
/// thread at a time.
class PoseEstimator {
public:
    explicit PoseEstimator(const PoseEstimatorOptions& options = {});

    /// The filtered pose at the frame's time. When no tag is visible or the measured pose is an
    /// outlier, the prediction (tags = 0), until the filter's limit is reached.
    std::optional<Pose> update(std::span<const TagObservation> tags, const CameraModel& camera,
                               Timestamp time);
    /// The unfiltered pose from the last frame's tags.
    [[nodiscard]] const std::optional<Pose>& raw() const { return raw_; }
    [[nodiscard]] std::optional<Pose> predict(Timestamp t) const { return filter_.predict(t); }
    /// The pose of a picture other than a video frame: measured, chosen by the prediction, not
    /// filtered and without effect on the filter. `T_camera_video`: video camera -> the picture's
    /// camera.
    [[nodiscard]] std::optional<Pose> measure(std::span<const TagObservation> tags,
                                              const CameraModel& camera,
                                              const RigidTransform& T_camera_video,
                                              Timestamp time) const;

    [[nodiscard]] int flips() const { return flips_; }        ///< changes between the two solutions
    [[nodiscard]] int rejected() const { return rejected_; }  ///< poses rejected as outliers
    [[nodiscard]] int jumps() const { return jumps_; }        ///< restarts after outliers

private:
    PoseEstimatorOptions options_;
    PlanarChoice choice_;
    PoseFilter filter_;
    std::optional<Pose> raw_;
    int flips_ = 0, rejected_ = 0, jumps_ = 0;
};

}  // namespace mfar
