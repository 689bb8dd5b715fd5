#pragma once

#include "base/heartbeats.h"
#include "daemon/camera_watch.h"
#include "daemon/histogram.h"
#include "daemon/learning_counts.h"
#include "daemon/message_ids.h"
#include "daemon/pose_counts.h"
#include "daemon/process_use.h"
#include "daemon/quality_counts.h"
#include "hal/still_matcher.h"
#include "pipeline/pipeline.h"
#include "pipeline/results.h"

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
    std::uint64_t mailbox = 0;   ///< replaced by a newer frame before they were processed
    std::uint64_t recorder = 0;  ///< shown, but not recorded
    std::uint64_t display = 0;   ///< finished, but not written by a display that is slower
};

struct StillCounts {
    std::uint64_t triggered = 0;
    std::uint64_t received = 0;
    std::uint64_t used = 0;        ///< became the reference of a frame
    std::uint64_t superseded = 0;  ///< by a newer one, before a frame could use them
    std::uint64_t lost = 0;        ///< triggered and not received in time
};

enum class CameraRole : std::uint8_t { Video, Still };

/// What makes the pictures, for people.
struct Rendering {
    std::string engine;    ///< see describe() in engine_config.h
    std::string renderer;  ///< of GL
    std::string source;    ///< with how its pictures get there
};

/// What was checked of what passes wrote.
struct ValidationCounts {
    std::uint64_t values = 0;
    std::uint64_t faults = 0;  ///< outputs that held a bad one
};

/// Everything counted since the start, and the latest frame. A copy, free of locks.
struct Counted {
    std::uint64_t frames = 0;
    double seconds = 0;  ///< from the first to the last picture
    double fps = 0;
    double recentFps = 0;  ///< of the last second, see PictureRate
    Histogram latencyMs;   ///< from the frame's arrival to its picture shown
    std::vector<std::pair<std::string, Histogram>> stageMs;
    std::array<std::uint64_t, kTileClasses> tiles{};
    std::uint64_t tilesMatchedSecond = 0;  ///< with the second still, too
    std::uint64_t tilesShowSecond = 0;
    double meanConfidence = 0;  ///< over the frames that used a still
    Drops drops;
    StillCounts stills;
    std::array<CameraState, 2> cameras{};  ///< by CameraRole
    StillCounters matching;                ///< zero without a trigger line of ours
    PoseCounts poses;
    QualityCounts quality;
    std::uint64_t epipolarFrames = 0;     ///< pictures that were matched along epipolar lines
    std::uint64_t predictedFrames = 0;    ///< of them, around what the frame before showed
    std::uint64_t refinedFrames = 0;      ///< of them, with a pose refined from the pictures
    double meanEpipolarError = 0;         ///< [video px], over those with patches to tell it
    std::uint64_t depthTiles = 0;         ///< of all frames, where real depth was measured
    std::uint64_t depthTilesSkipped = 0;  ///< under virtual objects, known to lie behind them
    std::uint64_t keyframeSearches = 0;   ///< frames whose depth was measured against a keyframe
    std::uint64_t tilesSearched2d = 0;    ///< as the lines did not explain them
    std::uint64_t objectFrames = 0;       ///< with virtual objects in view
    std::uint64_t hiddenFrames = 0;       ///< of them, with all of them behind real things
    std::optional<TracedLayerCounters> traced;  ///< of the path tracer, where there is one
    std::optional<double> referenceAgeS;        ///< of the picture it showed, at the last frame
    FrameStats last;
    std::vector<StageTime> lastStages;
    std::optional<double> stillAgeS;         ///< at the last frame
    std::optional<std::string> fault;        ///< of a device, as the picture says it
    std::string display;                     ///< what is shown where
    std::uint64_t faults = 0;                ///< times that there was none before
    std::optional<Timestamp> lastPicture{};  ///< see FinishedPicture::since
    std::optional<Timestamp>
        lastBanner{};  ///< when a picture that says a fault was, without frames
    std::optional<std::string> displayFault{};  ///< see Display::fault()
    std::optional<std::string> gpuFault{};      ///< see GpuWatch, GpuFailures
    std::uint64_t gpuFailures = 0;              ///< times that all on the GPU was lost
    std::optional<Rendering> rendering{};       ///< where it has changed since the start
    ValidationCounts validation{};              ///< zero where it is not asked for
    std::optional<ProcessUse> atFirstPicture;   ///< when the display had it
    std::optional<LearningCounts> learning{};   ///< where filters are learned
    std::filesystem::path recording;            ///< the folder; empty: nothing is recorded
};

/// One finished picture.
struct FinishedPicture {
    FrameStats stats;
    const std::vector<StageTime>& stages;
    Timestamp arrived;  ///< of the video frame in the daemon, CLOCK_MONOTONIC
    Timestamp shown;    ///< CLOCK_MONOTONIC
    std::optional<double> stillAgeS;
    double ms = 0;  ///< from the frame's begin to `shown`, with the work for a new still
    /// From when on it grows old, CLOCK_MONOTONIC: a sensor's frame may have waited for a driver.
    std::optional<Timestamp> since{};  ///< nothing: since it is shown
};

/// How fast pictures come, from the times of the last ones. It does not depend on who asks when.
class PictureRate {
public:
    void add(Timestamp shown);
    /// Of the pictures of the last second before the newest, at least of the last two. Where the
    /// next one is overdue, one picture in the time since: a rate that falls as long as none comes.
    [[nodiscard]] double at(Timestamp now) const;

private:
    static constexpr std::size_t kMost = 128;  // more than a screen shows in a second
    std::array<Timestamp, kMost> times_{};     // a ring
    std::size_t count_ = 0;                    // of all
};

/// What the log is to say, once.
struct Warning {
    std::string text;
    Subject subject{};
};

/// Collects what the threads report. Thread-safe.
class Stats {
public:
    /// Of the threads that report.
    [[nodiscard]] Heartbeats& heartbeats() { return heartbeats_; }

    void picture(const FinishedPicture& picture);
    void firstPicture(const ProcessUse& use);
    /// What is missing, as the picture says it; nothing when all is well.
    void fault(const std::optional<std::string>& fault);
    /// The log is to say this, once.
    void warn(std::string text, Subject subject = {});
    [[nodiscard]] std::vector<Warning> takeWarnings();
    /// What is shown where, as Display::name() says it now.
    void display(const std::string& name);
    /// See Display::fault(), leftOut().
    void displayed(const std::optional<std::string>& fault, std::uint64_t leftOut);
    /// See GpuWatch::fault(), GpuFailures::fault().
    void gpu(const std::optional<std::string>& fault);
    /// The same, where all on the GPU was lost once more.
    void gpuFailed(const std::optional<std::string>& fault);
    void rendering(const Rendering& changed);
    /// A picture was shown that says what is missing, while no frames come.
    void bannerShown(Timestamp shown);
    /// Totals so far.
    void validation(const ValidationCounts& counts);
    /// Nothing where no filters are learned.
    void learning(const std::optional<LearningCounts>& counts);
    /// Of the path tracer, at a frame's time.
    void traced(const TracedLayerCounters& counters, Timestamp frame);
    void camera(CameraRole role, const CameraState& state);
    void stillReceived();
    void stillUsed();
    void stillsSuperseded(std::uint64_t stills);
    /// See PoseCounts.
    void framePose(const std::optional<Pose>& pose, const std::optional<TrackStats>& tracker);
    void stillPose(const std::optional<Pose>& pose, const std::optional<double>& ms);
    /// Level of the following pictures, and their deadline [ms], 0: none.
    void quality(const std::string& level, double deadlineMs);
    void triggers(std::uint64_t fired, std::uint64_t lost);
    void matching(const StillCounters& counters);
    void mailboxDropped(std::uint64_t total);
    void recorderDropped(std::uint64_t total);
    /// What is recorded into; empty: nothing is.
    void recording(const std::filesystem::path& folder);

    [[nodiscard]] Counted count(Timestamp now = Timestamp::now());

private:
    void total(Timestamp now);
    /// How old what the cameras sent is.
    void age(Timestamp now);
    /// What virtual objects needed of a picture. Under the mutex, too.
    void objects(const FrameStats& frame);

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
    Heartbeats heartbeats_;
};

}  // namespace mfar
