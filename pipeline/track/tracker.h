#pragma once

#include "pipeline/track/corner_refine.h"
#include "pipeline/track/luma_window.h"
#include "pipeline/track/pose_estimator.h"
#include "pipeline/track/tag_detector.h"
#include "pipeline/track/tag_map.h"

#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

namespace mfar {

struct TrackerOptions {
    /// The coordinates of the map are the world, and only tags of the map's families are searched.
    /// If the map is empty, tags of `families` are searched instead. In the first video frame that
    /// shows tags with a usable pose, the largest of these tags becomes the world: the origin is
    /// its centre, x points right and y up in its print, and z out of the print. If the filter
    /// stops predicting before it has accepted this tag's pose in five frames, the tag counts as a
    /// false detection, and another tag becomes the world.
    TagMap map;
    std::vector<TagFamily> families{TagFamily::Tag36h11};
    double tagSize = 0.1;  ///< size of the tag that becomes the world [m]
    /// DetectorOptions::decimation for video and for stills.
    double decimation = 2;
    double stillDecimation = 4;
    int threads = 1;  ///< threads of libapriltag for each sensor
    /// The whole picture is searched in at least every n-th frame, n >= 1.
    int fullSearchInterval = 15;
    /// Gamma of the video and of stills, see CornerRefiner.
    double gamma = 2;
    double stillGamma = 2;
    PoseEstimatorOptions pose;
};

struct TrackStats {
    std::int64_t frames = 0;
    std::int64_t fullSearches = 0;  ///< frames that were searched completely
    std::int64_t roiSearches = 0;   ///< frames that were searched only around the expected tags
    /// flips: number of changes from one of the two planar solutions to the other. rejected: number
    /// of poses that the filter rejected as outliers. jumps: number of restarts of the filter
    /// because several outliers agreed with each other.
    int flips = 0;
    int rejected = 0;
    int jumps = 0;
    // Durations of track(): of the last call, mean and largest.
    double lastMs = 0;
    double meanMs = 0;
    double worstMs = 0;
};

/// Tracks the pose of the video camera from AprilTags. track() must always be called from the same
/// thread; it need not be the thread that processes pictures. trackStill() may be called from one
/// other thread at the same time. All other functions are thread-safe, except detections().
class Tracker {
public:
    Tracker(const StereoRig& rig, TrackerOptions options);

    /// Processes a video frame of any format. Times must increase; a time that is not later than
    /// the last one restarts the filter. Returns the filtered pose. If no tag of the map is usable,
    /// or if the measured pose is an outlier, returns the filter's prediction (tags = 0). Returns
    /// nothing if the filter does not predict any more. Throws std::invalid_argument if the picture
    /// does not have the size of the rig's video.
    std::optional<Pose> track(const ImageView& picture, Timestamp time);
    /// Unfiltered pose of the last frame. Empty if the frame had no usable tag. Pose::world is 0.
    [[nodiscard]] std::optional<Pose> raw() const;
    /// See PoseFilter::predict(). Pose::world is 0.
    [[nodiscard]] std::optional<Pose> predict(Timestamp time) const;
    /// Returns the video camera's pose at the time of a still. The tags are found in the still
    /// itself, and T_still_video is used to compute the pose of the video camera. The pose is not
    /// filtered. Returns nothing if the still shows no usable tag of the map. Throws
    /// std::invalid_argument if the picture does not have the size of the rig's still.
    [[nodiscard]] std::optional<Pose> trackStill(const ImageView& still, Timestamp time);

    /// All tags found in the last frame, with refined corners. They include tags that are not in
    /// the map. May be called only from the thread of track(). Valid until the next call of
    /// track().
    [[nodiscard]] const std::vector<TagDetection>& detections() const { return detections_; }
    [[nodiscard]] TrackStats stats() const;
    /// Returns the map of the options. If that is empty, returns a map with the tag that became the
    /// world, or an empty map if the filter has not yet accepted its pose in five frames.
    [[nodiscard]] TagMap map() const;

private:
    struct Eye {
        CameraModel camera;
        double decimation;
        TagDetector detector;
        CornerRefiner refiner;
        LumaWindow luma;
    };

    [[nodiscard]] static Eye eye(const CameraModel& camera, double decimation, double gamma,
                                 const TrackerOptions& options);
    [[nodiscard]] static std::vector<TagDetection> search(Eye& eye, const ImageView& picture,
                                                          const std::vector<PixelRect>& regions);
    [[nodiscard]] std::vector<TagDetection> searchVideo(const ImageView& picture, Timestamp time);
    [[nodiscard]] std::vector<PixelRect> regionsFor(const CameraModel& camera,
                                                    const RigidTransform& T_camera_video,
                                                    Timestamp time) const;
    [[nodiscard]] std::vector<TagObservation> placed(const std::vector<TagDetection>& tags) const;
    void adoptWorld(std::vector<TagDetection> tags);
    void proveWorld(const std::optional<Pose>& filtered);
    [[nodiscard]] bool isProven() const;
    [[nodiscard]] std::optional<Pose> inThisWorld(std::optional<Pose> pose) const;
    void count(double ms);

    StereoRig rig_;
    TrackerOptions options_;
    Eye video_, still_;
    std::vector<TagDetection> detections_;
    int sinceFullSearch_ = 0;

    mutable std::mutex mutex_;  ///< guards the members below
    TagMap map_;
    int world_ = 0;        ///< see Pose::world
    int worldFrames_ = 0;  ///< frames with an accepted pose since a tag became the world
    PoseEstimator estimator_;
    TrackStats stats_;
};

}  // namespace mfar
