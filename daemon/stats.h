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

/// Frames that never became a picture, by cause.
struct Drops {
    std::uint64_t sensor = 0;    ///< missed by the video camera
    std::uint64_t mailbox = 0;   ///< replaced by a newer frame before processing
    std::uint64_t recorder = 0;  ///< shown, but not recorded
    std::uint64_t display = 0;   ///< finished, but not written because the display was slower
};

struct StillCounts {
    std::uint64_t triggered = 0;
    std::uint64_t received = 0;
    std::uint64_t used = 0;        ///< became the reference of a frame
    std::uint64_t superseded = 0;  ///< replaced by a newer still before a frame could use it
    std::uint64_t lost = 0;        ///< triggered and not received in time
};

enum class CameraRole : std::uint8_t { Video, Still };

/// Description of the rendering, for people.
struct Rendering {
    std::string engine;    ///< see describe() in engine_config.h
    std::string renderer;  ///< of GL
    std::string source;    ///< with the way that its pictures take to the GPU
};

/// Numbers of values that the validation checked.
struct ValidationCounts {
    std::uint64_t values = 0;
    std::uint64_t faults = 0;  ///< outputs with a bad value
};

/// All counters since the start, and the latest frame's. A copy, read without locks.
struct Counted {
    std::uint64_t frames = 0;
    double seconds = 0;  ///< from the first to the last picture
    double fps = 0;
    double recentFps = 0;  ///< over the last second, see PictureRate
    Histogram latencyMs;   ///< from the frame's arrival to its picture shown
    std::vector<std::pair<std::string, Histogram>> stageMs;
    std::array<std::uint64_t, kTileClasses> tiles{};
    std::uint64_t tilesMatchedSecond = 0;  ///< also matched with the second still
    std::uint64_t tilesShowSecond = 0;
    double meanConfidence = 0;  ///< mean over the frames that used a still
    Drops drops;
    StillCounts stills;
    std::array<CameraState, 2> cameras{};  ///< indexed by CameraRole
    StillCounters matching;                ///< zero without a trigger line of our own
    PoseCounts poses;
    QualityCounts quality;
    std::uint64_t epipolarFrames = 0;     ///< pictures that were matched along epipolar lines
    std::uint64_t predictedFrames = 0;    ///< epipolar frames searched around the previous result
    std::uint64_t refinedFrames = 0;      ///< epipolar frames with a pose refined from the pictures
    double meanEpipolarError = 0;         ///< [video px], mean over frames with enough patches
    std::uint64_t depthTiles = 0;         ///< over all frames: tiles with measured depth
    std::uint64_t depthTilesSkipped = 0;  ///< skipped, as known to lie behind virtual objects
    std::uint64_t keyframeSearches = 0;   ///< frames whose depth was measured against a keyframe
    std::uint64_t tilesSearched2d = 0;    ///< not explained by the search along lines
    std::uint64_t objectFrames = 0;       ///< frames with virtual objects in view
    std::uint64_t hiddenFrames = 0;       ///< object frames with all objects behind real things
    std::optional<TracedLayerCounters> traced;  ///< the path tracer's, if there is one
    std::optional<double> referenceAgeS;  ///< of the path traced picture shown, at the last frame
    FrameStats last;
    std::vector<StageTime> lastStages;
    std::optional<double> stillAgeS;         ///< at the last frame
    std::optional<std::string> fault;        ///< of a device, as in the banner
    std::string display;                     ///< display and what it shows, see Display::name()
    std::uint64_t faults = 0;                ///< number of times that a fault began
    std::optional<Timestamp> lastPicture{};  ///< see FinishedPicture::since
    std::optional<Timestamp> lastBanner{};   ///< when a banner was last shown without a new frame
    std::optional<std::string> displayFault{};  ///< see Display::fault()
    std::optional<std::string> gpuFault{};      ///< see GpuWatch, GpuFailures
    std::uint64_t gpuFailures = 0;              ///< number of losses of the GPU
    std::optional<Rendering> rendering{};       ///< set when it has changed since the start
    ValidationCounts validation{};              ///< zero without validation
    std::optional<ProcessUse> atFirstPicture;   ///< at the time of the first picture
    std::optional<LearningCounts> learning{};   ///< set where filters are learned
    std::filesystem::path recording;            ///< folder; empty: no recording
};

/// One finished picture.
struct FinishedPicture {
    FrameStats stats;
    const std::vector<StageTime>& stages;
    Timestamp arrived;  ///< arrival of the video frame in the daemon, CLOCK_MONOTONIC
    Timestamp shown;    ///< CLOCK_MONOTONIC
    std::optional<double> stillAgeS;
    double ms = 0;  ///< from the begin of processing to `shown`, including the work for a new still
    /// Time from which its age counts, CLOCK_MONOTONIC: a sensor's frame may have waited in a
    /// driver.
    std::optional<Timestamp> since{};  ///< nothing: `shown`
};

/// Rate of pictures over the last second. It does not depend on when it is queried.
class PictureRate {
public:
    void add(Timestamp shown);
    /// Mean rate over the second before the newest picture, at least over the last two pictures.
    /// When the next picture is overdue: one picture per time since the last, which falls until one
    /// comes.
    [[nodiscard]] double at(Timestamp now) const;

private:
    static constexpr std::size_t kMost = 128;  // more than a screen shows in a second
    std::array<Timestamp, kMost> times_{};     // ring buffer
    std::size_t count_ = 0;                    // of all pictures
};

/// A message for the log, to be logged once.
struct Warning {
    std::string text;
    Subject subject{};
};

/// Collects what the threads report. Thread-safe.
class Stats {
public:
    /// Heartbeats of all threads.
    [[nodiscard]] Heartbeats& heartbeats() { return heartbeats_; }

    void picture(const FinishedPicture& picture);
    void firstPicture(const ProcessUse& use);
    /// Current fault of a device, as in the banner; nothing without a fault.
    void fault(const std::optional<std::string>& fault);
    /// Queues a warning for the log.
    void warn(std::string text, Subject subject = {});
    [[nodiscard]] std::vector<Warning> takeWarnings();
    /// Display::name() now.
    void display(const std::string& name);
    /// See Display::fault(), leftOut().
    void displayed(const std::optional<std::string>& fault, std::uint64_t leftOut);
    /// See GpuWatch::fault(), GpuFailures::fault().
    void gpu(const std::optional<std::string>& fault);
    /// The same, after one more loss of the GPU.
    void gpuFailed(const std::optional<std::string>& fault);
    void rendering(const Rendering& changed);
    /// The last picture was shown again with a banner, as no frames came.
    void bannerShown(Timestamp shown);
    /// Totals so far.
    void validation(const ValidationCounts& counts);
    /// Nothing where no filters are learned.
    void learning(const std::optional<LearningCounts>& counts);
    /// Counters of the path tracer, at a frame's time.
    void traced(const TracedLayerCounters& counters, Timestamp frame);
    void camera(CameraRole role, const CameraState& state);
    void stillReceived();
    void stillUsed();
    void stillsSuperseded(std::uint64_t stills);
    /// See PoseCounts.
    void framePose(const std::optional<Pose>& pose, const std::optional<TrackStats>& tracker);
    void stillPose(const std::optional<Pose>& pose, const std::optional<double>& ms);
    /// Level of the following pictures, and their deadline [ms], 0: no deadline.
    void quality(const std::string& level, double deadlineMs);
    void triggers(std::uint64_t fired, std::uint64_t lost);
    void matching(const StillCounters& counters);
    void mailboxDropped(std::uint64_t total);
    void recorderDropped(std::uint64_t total);
    /// Folder of the recording; empty: no recording.
    void recording(const std::filesystem::path& folder);

    [[nodiscard]] Counted count(Timestamp now = Timestamp::now());

    /// From now on the course of the run is kept for a report.
    void keepHistory();
    [[nodiscard]] bool keepsHistory();
    /// Empty where it is not kept.
    [[nodiscard]] RunHistory history();
    /// Pictures for the report.
    void pictures(RunPictures pictures);
    [[nodiscard]] RunPictures pictures();

private:
    void total(Timestamp now);
    /// Updates the ages of what the cameras sent.
    void age(Timestamp now);
    /// Adds the counters of virtual objects. The mutex is held.
    void objects(const FrameStats& frame);
    /// Adds the picture to the history. The mutex is held.
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
