#pragma once

#include "base/geometry.h"
#include "base/heartbeats.h"
#include "daemon/camera_watch.h"
#include "daemon/config.h"
#include "daemon/exit_code.h"
#include "daemon/mailbox.h"
#include "daemon/pose_finder.h"
#include "hal/camera.h"
#include "hal/display.h"
#include "hal/still_matcher.h"
#include "hal/trigger.h"
#include "hal/virtual/display_files.h"
#include "hal/virtual/recorder.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace mfar {

class RigSource;

/// Numbers of pictures in a finished recording.
struct Recorded {
    std::uint64_t video = 0;
    std::uint64_t stills = 0;
    std::uint64_t dropped = 0;
};

/// The devices of one run. Only this class knows which kinds exist.
class Rig {
public:
    /// Opens the configured source. `hearts` watches its threads and must outlive this. Throws
    /// Failure.
    Rig(const Config& config, Heartbeats& hearts);
    /// Uses the given devices.
    explicit Rig(std::unique_ptr<RigSource> source);
    ~Rig();

    [[nodiscard]] const StereoRig& geometry() const;
    [[nodiscard]] Camera& video();
    [[nodiscard]] Camera& still();
    /// nullptr where stills are not triggered.
    [[nodiscard]] Trigger* trigger();
    [[nodiscard]] HandOver handOver() const;
    [[nodiscard]] CameraKind cameraKind() const;
    /// Add this to a still's time to get the time on the video's clock.
    [[nodiscard]] std::chrono::nanoseconds stillTimeOffset() const;
    /// Upper limit of the number of video frames, where it is known.
    [[nodiscard]] std::optional<std::uint64_t> videoFrames() const;
    /// Pose information: a recording's tags.toml and poses, or the synthetic board's tags. Valid as
    /// long as the rig. Throws Failure for an invalid tags.toml.
    [[nodiscard]] PoseInputs poseInputs() const;
    /// "synthetic office: video 640x480 at 30 Hz, still 2304x1728"
    [[nodiscard]] std::string description() const;
    /// Counters of the matching of stills to pulses, with a trigger line of our own.
    [[nodiscard]] std::optional<StillCounters> matching() const;
    /// Fault of a device that the rig waits for, in words; nothing without a fault.
    [[nodiscard]] std::optional<std::string> fault() const;
    /// Exit code when a camera fails.
    [[nodiscard]] ExitCode inputFailure() const;

    /// Copies a frame into the recording, if there is one; never waits. Each function is called
    /// from one thread only.
    void recordVideo(const Frame& frame);
    void recordStill(const Frame& frame);
    /// The same for the pose of a frame.
    void recordPose(const Pose& pose);
    void recordTags(const TagMap& tags);
    /// Number of frames and stills missing in the recording. Any thread.
    [[nodiscard]] std::uint64_t notRecorded() const;
    /// Folder of the recording; empty: no recording. Any thread.
    [[nodiscard]] std::filesystem::path recordingFolder() const;
    /// When the recording can no longer be written: ends it and returns the reason; the part on
    /// disk stays readable. Any thread, never waits.
    [[nodiscard]] std::optional<std::string> endBrokenRecording();
    /// Waits until everything is written. Throws Failure when a recording that --record asked for
    /// cannot be written; endBrokenRecording() reports failures of others.
    void finishRecording();
    /// Returns a function that creates a recording in this new folder. The function may wait for
    /// the disk, throws Failure, and may outlive this. Throws Failure while a recording is running.
    /// Any thread, as the next two.
    [[nodiscard]] std::function<std::shared_ptr<Recorder>()>
    makeRecording(const std::filesystem::path& folder) const;
    /// Records into it from now on. Throws Failure as makeRecording() does.
    void startRecording(std::shared_ptr<Recorder> recorder);
    /// Ends the recording. Returns a function that waits until it is complete on disk, throws
    /// Failure when that fails, and may outlive this. Throws Failure without a recording.
    [[nodiscard]] std::function<Recorded()> stopRecording();

private:
    [[nodiscard]] std::shared_ptr<Recorder> recorder() const;
    void requireNoRecorder() const;

    std::unique_ptr<RigSource> source_;
    RecorderOptions recording_;
    bool mustRecord_ = false;
    mutable std::mutex mutex_;
    std::shared_ptr<Recorder> recorder_;
    std::uint64_t lostBefore_ = 0;      ///< pictures missing in recordings that have ended
    std::optional<std::string> broke_;  ///< error that ended the last recording
    std::vector<std::jthread> ending_;  ///< closing broken recordings may wait for the disk
};

/// A folder in `directory` for a recording that begins now, named by the time (UTC), that does not
/// exist yet.
[[nodiscard]] std::filesystem::path newRecordingIn(const std::filesystem::path& directory);

/// Drives a trigger line to its safe level. Throws Failure.
void releaseTrigger(const TriggerLineConfig& line);

/// Opens the configured display. A stop request on `cancel` ends its waiting. Throws Failure.
[[nodiscard]] std::unique_ptr<Display> openDisplay(const Config& config, double rateHz,
                                                   std::stop_token cancel,
                                                   const FileDisplayPolicy& policy = {});

/// A copy of a picture, see copyPicture().
[[nodiscard]] ScreenPicture copyOf(const Picture& picture);

}  // namespace mfar
