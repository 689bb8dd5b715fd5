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
    /// Where the tags are; their frame is the world, and only their families are sought. Empty: the
    /// largest tag of the first picture with one becomes the map, and `families` are sought. The
    /// world then stands on it: x to the right and y up in its print, z out of it.
    TagMap map;
    std::vector<TagFamily> families{TagFamily::Tag36h11};
    double tagSize = 0.1;         ///< of the tag that becomes the world without a map [m]
    double decimation = 2;        ///< of the video, see DetectorOptions
    double stillDecimation = 4;   ///< of the stills
    int threads = 1;              ///< of libapriltag, per sensor
    int fullSearchInterval = 15;  ///< frames from one search of the whole picture to the next
    double gamma = 2;             ///< of the video, see CornerRefiner
    double stillGamma = 2;        ///< of the stills
    PoseEstimatorOptions pose;
};

struct TrackStats {
    std::int64_t frames = 0;
    std::int64_t fullSearches = 0;  ///< of the whole picture: at start, at intervals, when lost
    std::int64_t roiSearches = 0;   ///< frames in which the predicted regions were enough
    int flips = 0;                  ///< changes between the two planar solutions
    int rejected = 0;               ///< poses that were outliers to the filter
    int jumps = 0;                  ///< new starts of the filter after outliers that agreed
    double lastMs = 0;              ///< detector and pose of the last frame
    double meanMs = 0;
    double worstMs = 0;
};

/// Where the video camera is, frame by frame, from AprilTags.
///
/// track() is for one thread, which may be another one than the GL thread; trackStill() may run in
/// a third one at the same time; everything else may be called from any.
class Tracker {
public:
    /// Throws std::invalid_argument for options out of their range.
    Tracker(const StereoRig& rig, TrackerOptions options);

    /// One video frame of the rig's video size, Gray8 or Rgba8; times must rise, a step back starts
    /// anew. The filtered pose at `time`; without a tag the predicted one (tags = 0) for as long as
    /// the filter bridges, then nothing. Throws std::invalid_argument for another size.
    std::optional<Pose> track(const ImageView& picture, Timestamp time);
    /// What the tags of the last frame alone say.
    [[nodiscard]] std::optional<Pose> raw() const;
    /// The video camera's pose at another time, such as when the picture will be shown.
    [[nodiscard]] std::optional<Pose> predict(Timestamp time) const;
    /// The pose of the video camera at the time of a still, measured in the still itself with the
    /// still camera and T_still_video; not filtered. Nothing when it shows no tag that can be used.
    [[nodiscard]] std::optional<Pose> trackStill(const ImageView& still, Timestamp time);

    /// Tags of the last frame, corners sharpened; those that are not in the map as well. For the
    /// thread of track(), until its next call.
    [[nodiscard]] const std::vector<TagDetection>& detections() const { return detections_; }
    [[nodiscard]] TrackStats stats() const;
    /// As it was given, or with the tag that became the world; empty before that.
    [[nodiscard]] TagMap map() const;

private:
    /// One sensor's way from a picture to detections.
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

    mutable std::mutex mutex_;  ///< of all below
    TagMap map_;
    PoseEstimator estimator_;
    TrackStats stats_;
};

}  // namespace mfar
