#pragma once

#include "base/heartbeats.h"
#include "daemon/camera_watch.h"
#include "daemon/histogram.h"
#include "daemon/learning_counts.h"
#include "daemon/message_ids.h"
#include "daemon/pose_counts.h"
#include "daemon/process_use.h"
#include "daemon/quality_counts.h"
#include "daemon/run_history.h"
#include "hal/still_matcher.h"
#include "pipeline/results.h"
#include "pipeline/stage_clock.h"
#include "pipeline/traced_layer.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mfar {

/// Numbers of lost frames and pictures.
struct Drops {
    std::uint64_t sensor = 0;
    std::uint64_t mailbox = 0;  ///< frames replaced by a newer frame before processing
    std::uint64_t recorder = 0;
    std::uint64_t display = 0;  ///< pictures that a slow display did not write
};

struct StillCounts {
    std::uint64_t triggered = 0;   ///< trigger pulses, including repetitions
    std::uint64_t received = 0;    ///< stills from the camera, including late ones
    std::uint64_t used = 0;        ///< received stills that were matched with the video
    std::uint64_t superseded = 0;  ///< received stills that were replaced by newer ones before use
    /// Trigger pulses whose still has not arrived, not even after its timeout.
    std::uint64_t lost = 0;
};

enum class CameraRole : std::uint8_t { Video, Still };

struct Rendering {
    std::string engine;
    std::string renderer;
    std::string source;
};

struct ValidationCounts {
    std::uint64_t values = 0;
    std::uint64_t faults = 0;
};

/// All counters since the start, and values of the latest frame.
struct Counted {
    std::uint64_t frames = 0;
    double seconds = 0;
    double fps = 0;
    double recentFps = 0;
    Histogram latencyMs;
    std::vector<std::pair<std::string, Histogram>> stageMs;
    std::array<std::uint64_t, kTileClasses> tiles{};
    std::uint64_t tilesMatchedSecond = 0;
    std::uint64_t tilesShowSecond = 0;
    double meanConfidence = 0;
    Drops drops;
    StillCounts stills;
    std::array<CameraState, 2> cameras{};
    StillCounters matching;  ///< how stills match trigger pulses; all 0 without a trigger line
    PoseCounts poses;
    QualityCounts quality;
    std::uint64_t epipolarFrames = 0;
    /// Frames whose search along epipolar lines was limited to positions near the previous matches.
    std::uint64_t predictedFrames = 0;
    /// Frames that were matched along epipolar lines and whose pose was refined from the pictures.
    std::uint64_t refinedFrames = 0;
    /// Mean of FrameStats::epipolarError over the frames whose posePatches is not 0 [video px].
    double meanEpipolarError = 0;
    std::uint64_t depthTiles = 0;  ///< sum of FrameStats::depthTiles over all frames
    /// Tiles that show a virtual object, and whose depth was not measured, because the real surface
    /// is known to lie behind the object.
    std::uint64_t depthTilesSkipped = 0;
    /// Frames whose depth was measured with a keyframe, alone or together with the still.
    std::uint64_t keyframeSearches = 0;
    /// Tiles that were searched in both dimensions, because they had no reliable match on epipolar
    /// lines.
    std::uint64_t tilesSearched2d = 0;
    /// objectFrames: frames with virtual objects in view. hiddenFrames: those among them in which
    /// all objects were hidden.
    std::uint64_t objectFrames = 0;
    std::uint64_t hiddenFrames = 0;
    std::optional<TracedLayerCounters> traced;
    /// Age of the shown traced picture, counted from the time at which its view was chosen.
    std::optional<double> referenceAgeS;
    FrameStats last;
    std::vector<StageTime> lastStages;
    std::optional<double> stillAgeS;
    std::optional<std::string> fault;
    std::string display;
    std::uint64_t faults = 0;                ///< number of faults of devices
    std::optional<Timestamp> lastPicture{};  ///< see FinishedPicture::since
    /// Last time at which there was a known reason for no new picture, see Stats::excused().
    std::optional<Timestamp> lastExcuse{};
    std::optional<std::string> displayFault{};
    std::optional<std::string> gpuFault{};
    std::uint64_t gpuFailures = 0;
    std::optional<Rendering> rendering{};  ///< set if it has changed since the start
    ValidationCounts validation{};         ///< all 0 if shader outputs are not validated
    std::optional<ProcessUse> atFirstPicture;
    std::optional<LearningCounts> learning{};
    std::filesystem::path recording;
    /// Reason why the recording of --record has ended too early.
    std::optional<std::string> lostRecording{};
};

struct FinishedPicture {
    FrameStats stats;
    const std::vector<StageTime>& stages;
    Timestamp arrived;  ///< CLOCK_MONOTONIC, like `shown`
    Timestamp shown;
    std::optional<double> stillAgeS;
    /// Time from the start of processing to `shown` [ms]. It includes the processing of a new
    /// still.
    double ms = 0;
    /// The age of this picture counts from this time, CLOCK_MONOTONIC. It may be earlier than
    /// `arrived`, because the frame may have waited in the sensor's driver. If it is not set, the
    /// age counts from `shown`.
    std::optional<Timestamp> since{};
};

/// Measures the rate of pictures over the last second.
class PictureRate {
public:
    void add(Timestamp shown);
    /// Returns the mean rate over the second before the newest picture, or over the last two
    /// pictures if they are farther apart. While the next picture is overdue, returns 1 / (time
    /// since the newest picture).
    [[nodiscard]] double at(Timestamp now) const;

private:
    // Size of the ring buffer. If more pictures are shown in a second, the mean covers less than a
    // second.
    static constexpr std::size_t kMost = 128;
    std::array<Timestamp, kMost> times_{};
    std::size_t count_ = 0;
};

struct Warning {
    std::string text;
    Subject subject{};
};

/// Collects the counters and messages of all threads. Thread-safe.
class Stats {
public:
    [[nodiscard]] Heartbeats& heartbeats() { return heartbeats_; }

    void picture(const FinishedPicture& picture);
    void firstPicture(const ProcessUse& use);
    void fault(const std::optional<std::string>& fault);
    void warn(std::string text, Subject subject = {});
    [[nodiscard]] std::vector<Warning> takeWarnings();
    void display(const std::string& name);
    void displayed(const std::optional<std::string>& fault, std::uint64_t leftOut);
    void gpu(const std::optional<std::string>& fault);
    void gpuFailed(const std::optional<std::string>& fault);
    void rendering(const Rendering& changed);
    /// Reports that there is no new picture for a known reason: instead of a new frame, a banner
    /// about a faulty device was shown, or mfard waits for something that is not faulty.
    void excused(Timestamp now);
    void validation(const ValidationCounts& counts);
    void learning(const std::optional<LearningCounts>& counts);
    /// `frame`: time of the frame to which the counters belong.
    void traced(const TracedLayerCounters& counters, Timestamp frame);
    void camera(CameraRole role, const CameraState& state);
    /// `exposed`: time of the still, in the clock of the video frames.
    void stillReceived(Timestamp exposed);
    void stillUsed();
    void stillsSuperseded(std::uint64_t stills);
    /// framePose() counts the pose of a frame, stillPose() the pose of a still, see PoseCounts.
    void framePose(const std::optional<Pose>& pose, const std::optional<TrackStats>& tracker);
    void stillPose(const std::optional<Pose>& pose, const std::optional<double>& ms);
    /// Sets the governor's level and the deadline [ms] of the following pictures. `deadlineMs` is 0
    /// if there is no deadline.
    void quality(const std::string& level, double deadlineMs);
    /// `timedOut`: pulses whose still did not arrive in time; it may have arrived later.
    /// `pendingSince`: see StillPolicy::pendingSince().
    void triggers(std::uint64_t fired, std::uint64_t timedOut,
                  std::optional<Timestamp> pendingSince);
    void matching(const StillCounters& counters);
    void mailboxDropped(std::uint64_t total);
    void recorderDropped(std::uint64_t total);
    /// `lost`: see Counted::lostRecording.
    void recording(const std::filesystem::path& folder, const std::optional<std::string>& lost);

    [[nodiscard]] Counted count(Timestamp now = Timestamp::now());

    void keepHistory();
    [[nodiscard]] bool keepsHistory();
    [[nodiscard]] RunHistory history();
    void pictures(RunPictures pictures);
    [[nodiscard]] RunPictures pictures();

private:
    /// The caller of these five functions must have locked mutex_.
    void total(Timestamp now);
    void countLost();
    void age(Timestamp now);
    void objects(const FrameStats& frame);
    void remember(const FinishedPicture& picture);

    std::mutex mutex_;
    Counted counted_;
    double confidenceSum_ = 0;
    std::uint64_t confidenceFrames_ = 0;
    double epipolarErrorSum_ = 0;
    std::uint64_t epipolarErrorFrames_ = 0;
    std::optional<Timestamp> firstShown_;
    Timestamp lastShown_;
    std::uint64_t timedOut_ = 0;
    std::optional<Timestamp> pendingSince_, newestStill_;
    PictureRate rate_;
    std::vector<Warning> warnings_;
    struct {
        std::optional<Timestamp> since;
        bool isCounted = false;
    } fault_;  // the present fault
    // Counters of the present path tracer, and sums of those before it.
    TracedLayerCounters traced_, tracedBefore_;
    std::optional<RunHistory> history_;
    RunPictures pictures_;
    Heartbeats heartbeats_;
};

}  // namespace mfar
