#pragma once

#include "pipeline/track/pose_filter.h"
#include "pipeline/track/tag_pose.h"

#include <optional>
#include <span>

namespace mfar {

struct PlanarChoiceOptions {
    double errorSigma = 0.25;  ///< noise of a corner's coordinates that the evidence assumes [px]
    /// Evidence from which on the other solution is chosen: log likelihood ratio of the corners,
    /// summed over frames.
    double threshold = 12;
    double memory = 0.95;  ///< factor that reduces the evidence from frame to frame, [0, 1)
};

/// Chooses one of the two poses from which a plane of tags looks nearly the same.
/// The pose nearer to the predicted motion is kept until the other pose explains the corners
/// significantly better, in one frame or over many frames. Noise therefore does not flip the pose
/// when the plane is seen from straight ahead, where both errors are equal. A wrong first choice is
/// corrected.
class PlanarChoice {
public:
    /// Throws std::invalid_argument if an option is out of range.
    explicit PlanarChoice(const PlanarChoiceOptions& options = {});

    /// Returns a reference into `poses`. Without a prediction, returns the pose with the smaller
    /// error.
    [[nodiscard]] const CameraPose& choose(const CameraPoses& poses,
                                           const std::optional<RigidTransform>& predicted);
    /// Whether the last call changed to the pose that is farther from the prediction.
    [[nodiscard]] bool flipped() const { return flipped_; }

private:
    PlanarChoiceOptions options_;
    double evidence_ = 0;  ///< evidence for the solution that is not chosen
    bool flipped_ = false;
};

struct PoseEstimatorOptions {
    TagPoseOptions tagPose;
    PlanarChoiceOptions choice;
    PoseFilterOptions filter;
};

/// Estimates the camera's motion from the tags in each video frame: solves for the pose, chooses a
/// solution, and filters it. One thread at a time may use it.
class PoseEstimator {
public:
    explicit PoseEstimator(const PoseEstimatorOptions& options = {});

    /// Returns the filtered pose at the frame's time. If no tag is visible or the measured pose is
    /// an outlier, returns the predicted pose (tags = 0) until the filter's limit is reached.
    std::optional<Pose> update(std::span<const TagObservation> tags, const CameraModel& camera,
                               Timestamp time);
    /// The unfiltered pose from the last frame's tags.
    [[nodiscard]] const std::optional<Pose>& raw() const { return raw_; }
    [[nodiscard]] std::optional<Pose> predict(Timestamp t) const { return filter_.predict(t); }
    /// Measures the pose in a picture that is not a video frame. The solution is chosen with the
    /// filter's prediction. The pose is not filtered, and the filter does not change.
    /// `T_camera_video` transforms from the video camera to the picture's camera.
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
