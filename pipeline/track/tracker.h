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
    /// The poses of the tags; their frame is the world, and only their families are searched. If
    /// empty, `families` are searched, and the largest tag of the first picture with a tag becomes
    /// the map. The world then stands on that tag: x to the right and y up in its print, z out of
    /// it.
    TagMap map;
    std::vector<TagFamily> families{TagFamily::Tag36h11};
    double tagSize = 0.1;         ///< of the tag that becomes the world when there is no map [m]
    double decimation = 2;        ///< for the video, see DetectorOptions
    double stillDecimation = 4;   ///< for stills
    int threads = 1;              ///< of libapriltag, per sensor
    int fullSearchInterval = 15;  ///< frames from one search of the whole picture to the next
    double gamma = 2;             ///< of the video, see CornerRefiner
    double stillGamma = 2;        ///< of the stills
    PoseEstimatorOptions pose;
};

struct TrackStats {
    std::int64_t frames = 0;
    std::int64_t fullSearches = 0;  ///< of the whole picture: at start, at intervals, when lost
    std::int64_t roiSearches = 0;   ///< frames in which the predicted regions sufficed
    int flips = 0;                  ///< changes between the two planar solutions
    int rejected = 0;               ///< poses that the filter rejected as outliers
    int jumps = 0;                  ///< restarts of the filter after consistent outliers
    double lastMs = 0;              ///< time of detection and pose for the last frame
    double meanMs = 0;
    double worstMs = 0;
};

/// Tracks the video camera's pose, frame by frame, from AprilTags.
///
/// track() runs on one thread, which may differ from the GL thread; trackStill() may run on another
/// one at the same time; all other functions may be called from any thread.
class Tracker {
public:
    /// Throws std::invalid_argument for options out of their range.
    Tracker(const StereoRig& rig, TrackerOptions options);

    /// Processes one video frame of the rig's video size, Gray8 or Rgba8; times must rise, and a
    /// step back restarts the filter. Returns the filtered pose at `time`. Without a tag, returns
    /// the predicted pose (tags = 0) as long as the filter bridges the gap, then nothing. Throws
    /// std::invalid_argument for another size.
    std::optional<Pose> track(const ImageView& picture, Timestamp time);
    /// The unfiltered pose from the tags of the last frame.
    [[nodiscard]] std::optional<Pose> raw() const;
    /// The video camera's pose at another time, for example when the picture will be displayed.
    [[nodiscard]] std::optional<Pose> predict(Timestamp time) const;
    /// The video camera's pose at the time of a still, measured in the still itself with the still
    /// camera and T_still_video; not filtered. Empty when the still shows no usable tag.
    [[nodiscard]] std::optional<Pose> trackStill(const ImageView& still, Timestamp time);

    /// Tags of the last frame with refined corners, including tags that are not in the map. For the
    /// thread of track(), until its next call.
    [[nodiscard]] const std::vector<TagDetection>& detections() const { return detections_; }
    [[nodiscard]] TrackStats stats() const;
    /// The given map, or the one with the tag that became the world; empty before that.
    [[nodiscard]] TagMap map() const;

private:
    /// Everything needed to get from one sensor's pictures to detections.
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
    void adoptWorld(const std::vector<TagDetection>& tags);
    void count(double ms);

    StereoRig rig_;
    TrackerOptions options_;
    Eye video_, still_;
    std::vector<TagDetection> detections_;
    int sinceFullSearch_ = 0;

    mutable std::mutex mutex_;  ///< protects all members below
    TagMap map_;
    PoseEstimator estimator_;
    TrackStats stats_;
};

}  // namespace mfar
