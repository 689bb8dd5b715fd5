#pragma once

#include "pipeline/track/pose_filter.h"
#include "pipeline/track/tag_pose.h"

#include <optional>
#include <span>

namespace mfar {

struct PlanarChoiceOptions {
    double errorSigma = 0.25;  ///< noise of a corner's coordinates that evidence is weighed by [px]
    /// Evidence at which the other solution takes over: logarithm of how much better it explains
    /// the corners, summed over frames.
    double threshold = 12;
    double memory = 0.95;  ///< share of the evidence that a frame leaves to the next one, [0, 1)
};

/// Decides between the two poses from which a plane of tags looks nearly the same. The one nearer
/// to the predicted motion stands until the other has explained the corners so much better, in one
/// frame or over many, that chance is ruled out. So noise does not flip the pose when the plane is
/// seen from straight ahead, where the two errors are equal, and a wrong start is put right.
class PlanarChoice {
public:
    /// Throws std::invalid_argument for options out of their range.
    explicit PlanarChoice(const PlanarChoiceOptions& options = {});

    /// A reference into `poses`. No prediction: the one with the smaller error.
    [[nodiscard]] const CameraPose& choose(const CameraPoses& poses,
                                           const std::optional<RigidTransform>& predicted);
    /// True when the last choice took over against the prediction.
    [[nodiscard]] bool flipped() const { return flipped_; }

private:
    PlanarChoiceOptions options_;
    double evidence_ = 0;  ///< for the solution that does not stand
    bool flipped_ = false;
};

struct PoseEstimatorOptions {
    TagPoseOptions tagPose;
    PlanarChoiceOptions choice;
    PoseFilterOptions filter;
};

/// From the tags of each video frame to the camera's motion: solution, choice, filter. One thread
/// at a time.
class PoseEstimator {
public:
    explicit PoseEstimator(const PoseEstimatorOptions& options = {});

    /// The filtered pose at the frame's time, also when no tag was seen or what was seen is an
    /// outlier (tags = 0 then), until the filter gives up.
    std::optional<Pose> update(std::span<const TagObservation> tags, const CameraModel& camera,
                               Timestamp time);
    /// What the last frame's tags alone say.
    [[nodiscard]] const std::optional<Pose>& raw() const { return raw_; }
    [[nodiscard]] std::optional<Pose> predict(Timestamp t) const { return filter_.predict(t); }
    /// The pose of a picture beside the video: measured, chosen by the prediction, not filtered and
    /// of no effect on the filter. `T_camera_video`: video camera -> the picture's camera.
    [[nodiscard]] std::optional<Pose> measure(std::span<const TagObservation> tags,
                                              const CameraModel& camera,
                                              const RigidTransform& T_camera_video,
                                              Timestamp time) const;

    [[nodiscard]] int flips() const { return flips_; }        ///< changes between the solutions
    [[nodiscard]] int rejected() const { return rejected_; }  ///< poses that were outliers
    [[nodiscard]] int jumps() const { return jumps_; }        ///< new starts after outliers

private:
    PoseEstimatorOptions options_;
    PlanarChoice choice_;
    PoseFilter filter_;
    std::optional<Pose> raw_;
    int flips_ = 0, rejected_ = 0, jumps_ = 0;
};

}  // namespace mfar
