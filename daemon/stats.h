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

/// How many frames were lost, by the place where they were lost.
struct Drops {
    std::uint64_t sensor = 0;    ///< frames that the video camera lost
    std::uint64_t mailbox = 0;   ///< frames replaced by a newer frame before they were processed
    std::uint64_t recorder = 0;  ///< pictures that were not recorded
    std::uint64_t display = 0;   ///< pictures not written because the display was too slow
};

/// How many stills were triggered, arrived, used and lost.
struct StillCounts {
    std::uint64_t triggered = 0;
    std::uint64_t received = 0;
    std::uint64_t used = 0;        ///< stills that became the reference of a frame
    std::uint64_t superseded = 0;  ///< stills replaced by a newer one before a frame could use them
    std::uint64_t lost = 0;        ///< stills that were triggered but did not arrive in time
};

enum class CameraRole : std::uint8_t { Video, Still };

/// How pictures are made, as texts for the user.
struct Rendering {
    std::string engine;    ///< see describe() in engine_config.h
    std::string renderer;  ///< GlContext::description()
    std::string source;    ///< the source, and how its pictures get to the GPU
};

/// How many values the validation checked.
struct ValidationCounts {
    std::uint64_t values = 0;
    std::uint64_t faults = 0;  ///< number of shader outputs in which a wrong value was found
};

/// All counters since the start, and values of the latest frame.
struct Counted {
    std::uint64_t frames = 0;
    double seconds = 0;  ///< time from the first to the last picture
    double fps = 0;
    double recentFps = 0;  ///< pictures per second over the last second, see PictureRate
    Histogram latencyMs;   ///< times from the arrival of a frame to its shown picture [ms]
    std::vector<std::pair<std::string, Histogram>> stageMs;
    std::array<std::uint64_t, kTileClasses> tiles{};
    std::uint64_t tilesMatchedSecond = 0;  ///< tiles also matched with the second still
    std::uint64_t tilesShowSecond = 0;
    double meanConfidence = 0;  ///< mean confidence of the frames that used a still
    Drops drops;
    StillCounts stills;
    std::array<CameraState, 2> cameras{};  ///< indexed by CameraRole
    StillCounters matching;  ///< stills matched to pulses; zero if there is no trigger line
    PoseCounts poses;
    QualityCounts quality;
    std::uint64_t epipolarFrames = 0;   ///< number of frames matched along epipolar lines
    std::uint64_t predictedFrames = 0;  ///< epipolarFrames searched near the previous result
    std::uint64_t refinedFrames = 0;    ///< epipolarFrames with a pose refined from the pictures
    double meanEpipolarError = 0;       ///< mean over the frames with enough patches [video px]
    std::uint64_t depthTiles = 0;  ///< number of tiles with measured depth, summed over all frames
    std::uint64_t depthTilesSkipped = 0;  ///< tiles not measured, as they are behind the objects
    std::uint64_t keyframeSearches = 0;   ///< frames whose depth was measured against a keyframe
    std::uint64_t tilesSearched2d = 0;    ///< tiles that epipolar lines did not explain
    std::uint64_t objectFrames = 0;       ///< number of frames with virtual objects in view
    std::uint64_t hiddenFrames = 0;       ///< objectFrames in which all virtual objects were hidden
    std::optional<TracedLayerCounters> traced;  ///< path tracer's counters; not set: none
    std::optional<double> referenceAgeS;  ///< age of the traced picture that the last frame showed
    FrameStats last;
    std::vector<StageTime> lastStages;
    std::optional<double> stillAgeS;   ///< age of the still that the last frame used
    std::optional<std::string> fault;  ///< fault of a device, as in the banner
    std::string display;       ///< name of the display and what it shows, see Display::name()
    std::uint64_t faults = 0;  ///< number of times that a device's fault began
    std::optional<Timestamp> lastPicture{};     ///< see FinishedPicture::since
    std::optional<Timestamp> lastBanner{};      ///< time of the last banner without a new frame
    std::optional<std::string> displayFault{};  ///< see Display::fault()
    std::optional<std::string> gpuFault{};      ///< fault of the GPU, see GpuWatch and GpuFailures
    std::uint64_t gpuFailures = 0;              ///< number of losses of the GPU
    std::optional<Rendering> rendering{};      ///< set if the rendering has changed since the start
    ValidationCounts validation{};             ///< all zero if there is no validation
    std::optional<ProcessUse> atFirstPicture;  ///< resources used before the first picture
    std::optional<LearningCounts> learning{};  ///< set if filters are learned
    std::filesystem::path recording;           ///< folder of the recording; empty: none
};

/// One finished picture.
struct FinishedPicture {
    FrameStats stats;
    const std::vector<StageTime>& stages;
    Timestamp arrived;  ///< time of the video frame's arrival, CLOCK_MONOTONIC
    Timestamp shown;    ///< time when the picture was shown, CLOCK_MONOTONIC
    std::optional<double> stillAgeS;
    double ms =
        0;  ///< time from the start of processing, with that of a new still, to `shown` [ms]
    /// Time from which on the picture's age counts, CLOCK_MONOTONIC. It may be before `arrived`,
    /// because a frame may have waited in the sensor's driver. Not set: the age counts from
    /// `shown`.
    std::optional<Timestamp> since{};
};

/// Measures the rate of pictures over the last second. The result does not depend on when earlier
/// results were queried.
class PictureRate {
public:
    void add(Timestamp shown);
    /// Returns the mean rate over the second before the newest picture, or over the last two
    /// pictures if they are farther apart. While the next picture is overdue, returns 1 / (time
    /// since the newest picture).
    [[nodiscard]] double at(Timestamp now) const;

private:
    // Largest number of pictures in the ring buffer; a screen shows fewer in a second.
    static constexpr std::size_t kMost = 128;
    std::array<Timestamp, kMost> times_{};  // ring buffer
    std::size_t count_ = 0;                 // number of all pictures
};

/// A message that is logged once.
struct Warning {
    std::string text;
    Subject subject{};
};

/// Collects what the threads report. Thread-safe.
class Stats {
public:
    /// Returns the heartbeats of all threads.
    [[nodiscard]] Heartbeats& heartbeats() { return heartbeats_; }

    void picture(const FinishedPicture& picture);
    void firstPicture(const ProcessUse& use);
    /// Sets the current fault of a device, as in the banner. std::nullopt: there is no fault.
    void fault(const std::optional<std::string>& fault);
    /// Queues a warning for the log.
    void warn(std::string text, Subject subject = {});
    [[nodiscard]] std::vector<Warning> takeWarnings();
    /// Sets the current Display::name().
    void display(const std::string& name);
    /// Sets the current Display::fault() and Display::leftOut().
    void displayed(const std::optional<std::string>& fault, std::uint64_t leftOut);
    /// Sets the current fault of the GPU, see GpuWatch::fault(), GpuFailures::fault().
    void gpu(const std::optional<std::string>& fault);
    /// Counts a loss of the GPU and sets the fault of the GPU.
    void gpuFailed(const std::optional<std::string>& fault);
    void rendering(const Rendering& changed);
    /// Reports that the last picture was shown again, with a banner, because no frames arrived.
    void bannerShown(Timestamp shown);
    /// Sets the counts of the validation since the start.
    void validation(const ValidationCounts& counts);
    /// Sets the counters of filter learning. std::nullopt: filters are not learned.
    void learning(const std::optional<LearningCounts>& counts);
    /// Sets the counters of the path tracer. `frame`: time of the frame to which they belong.
    void traced(const TracedLayerCounters& counters, Timestamp frame);
    void camera(CameraRole role, const CameraState& state);
    void stillReceived();
    void stillUsed();
    void stillsSuperseded(std::uint64_t stills);
    /// framePose() counts the pose of a frame, stillPose() that of a still, see PoseCounts.
    void framePose(const std::optional<Pose>& pose, const std::optional<TrackStats>& tracker);
    void stillPose(const std::optional<Pose>& pose, const std::optional<double>& ms);
    /// Sets the level of the governor and the deadline [ms] of the following pictures. Deadline 0:
    /// there is none.
    void quality(const std::string& level, double deadlineMs);
    void triggers(std::uint64_t fired, std::uint64_t lost);
    void matching(const StillCounters& counters);
    void mailboxDropped(std::uint64_t total);
    void recorderDropped(std::uint64_t total);
    /// Sets the folder of the recording. An empty path means that there is no recording.
    void recording(const std::filesystem::path& folder);

    [[nodiscard]] Counted count(Timestamp now = Timestamp::now());

    /// Keeps a history of the run from now on, for a report.
    void keepHistory();
    [[nodiscard]] bool keepsHistory();
    /// Returns the history. It is empty if keepHistory() was not called.
    [[nodiscard]] RunHistory history();
    /// Sets the pictures for the report.
    void pictures(RunPictures pictures);
    [[nodiscard]] RunPictures pictures();

private:
    void total(Timestamp now);
    /// Updates CameraState::distinctAgeS.
    void age(Timestamp now);
    /// Adds the counters of virtual objects. mutex_ must be locked.
    void objects(const FrameStats& frame);
    /// Adds the picture to the history. mutex_ must be locked.
    void remember(const FinishedPicture& picture);

    std::mutex mutex_;
    Counted counted_;
    double confidenceSum_ = 0;
    std::uint64_t confidenceFrames_ = 0;
    double epipolarErrorSum_ = 0;
    std::uint64_t epipolarErrorFrames_ = 0;
    std::optional<Timestamp> firstShown_;
    Timestamp lastShown_;
    PictureRate rate_;
    std::vector<Warning> warnings_;
    std::optional<RunHistory> history_;
    RunPictures pictures_;
    Heartbeats heartbeats_;
};

}  // namespace mfar
