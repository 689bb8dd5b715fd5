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

/// How many pictures a finished recording has.
struct Recorded {
    std::uint64_t video = 0;
    std::uint64_t stills = 0;
    std::uint64_t dropped = 0;
};

/// The devices of one run. Only this class knows which implementations of the devices exist.
class Rig {
public:
    /// Opens the configured source. Its threads register at `hearts`, which must outlive this
    /// object. Throws Failure.
    Rig(const Config& config, Heartbeats& hearts);
    /// Uses the given devices.
    explicit Rig(std::unique_ptr<RigSource> source);
    ~Rig();

    [[nodiscard]] const StereoRig& geometry() const;
    [[nodiscard]] Camera& video();
    [[nodiscard]] Camera& still();
    /// Returns the trigger of the still camera; null if stills are not triggered.
    [[nodiscard]] Trigger* trigger();
    [[nodiscard]] HandOver handOver() const;
    [[nodiscard]] CameraKind cameraKind() const;
    /// Returns the offset that is added to a still's time to get the time on the video camera's
    /// clock.
    [[nodiscard]] std::chrono::nanoseconds stillTimeOffset() const;
    /// Returns the largest possible number of video frames, if it is known.
    [[nodiscard]] std::optional<std::uint64_t> videoFrames() const;
    /// Returns what the source knows about poses: a recording's tags.toml and poses, or the tags of
    /// the simulated board. The result is valid as long as the rig lives.
    [[nodiscard]] PoseInputs poseInputs() const;
    /// Returns a description: "synthetic office: video 640x480 at 30 Hz, still 2304x1728".
    [[nodiscard]] std::string description() const;
    /// Returns the counters of the matching of stills to trigger pulses, if this rig has a trigger
    /// line.
    [[nodiscard]] std::optional<StillCounters> matching() const;
    /// Returns the fault of a device that the rig waits for, or nothing if there is no fault.
    [[nodiscard]] std::optional<std::string> fault() const;
    /// Returns the exit code of mfard for a camera that fails.
    [[nodiscard]] ExitCode inputFailure() const;

    /// Copies a frame into the recording, if one is running. Never waits. Only one thread may call
    /// recordVideo(), and only one may call recordStill().
    void recordVideo(const Frame& frame);
    void recordStill(const Frame& frame);
    /// Copies the pose of a frame into the recording, if one is running. Never waits.
    void recordPose(const Pose& pose);
    void recordTags(const TagMap& tags);
    /// Returns how many frames and stills are missing in the recordings of this run. Thread-safe.
    [[nodiscard]] std::uint64_t notRecorded() const;
    /// Returns the folder of the recording, or an empty path if there is no recording. Thread-safe.
    [[nodiscard]] std::filesystem::path recordingFolder() const;
    /// If the recording cannot be written any more, ends it and returns the reason. The part that
    /// is already on the disk can be played. Thread-safe; never waits.
    [[nodiscard]] std::optional<std::string> endBrokenRecording();
    /// Waits until the whole recording is written. Throws Failure if the recording that --record
    /// requested cannot be written. endBrokenRecording() reports failures of other recordings.
    void finishRecording();
    /// Returns a function that creates a recording in the new folder `folder`. The function may
    /// wait for the disk, throws Failure, and may outlive this object. makeRecording() itself
    /// throws Failure while a recording is running. makeRecording(), startRecording() and
    /// stopRecording() are thread-safe.
    [[nodiscard]] std::function<std::shared_ptr<Recorder>()>
    makeRecording(const std::filesystem::path& folder) const;
    /// Records into `recorder` from now on. Throws Failure while a recording is running.
    void startRecording(std::shared_ptr<Recorder> recorder);
    /// Ends the recording. Returns a function that waits until the recording is complete on the
    /// disk. This function throws Failure if the recording cannot be completed, and it may outlive
    /// this object. stopRecording() itself throws Failure if no recording is running.
    [[nodiscard]] std::function<Recorded()> stopRecording();

private:
    [[nodiscard]] std::shared_ptr<Recorder> recorder() const;
    void requireNoRecorder() const;

    std::unique_ptr<RigSource> source_;
    RecorderOptions recording_;
    bool mustRecord_ = false;
    mutable std::mutex mutex_;
    std::shared_ptr<Recorder> recorder_;
    std::uint64_t lostBefore_ = 0;  ///< number of pictures missing in recordings that have ended
    std::optional<std::string> broke_;  ///< error that ended the last recording
    std::vector<std::jthread> ending_;  ///< threads that close broken recordings
};

/// Returns the path of a new folder in `directory`, which does not exist yet. Its name is the
/// current time (UTC).
[[nodiscard]] std::filesystem::path newRecordingIn(const std::filesystem::path& directory);

/// Drives a trigger line to its inactive level. Throws Failure.
void releaseTrigger(const TriggerLineConfig& line);

/// Opens the configured display. If a stop is requested through `cancel`, the display stops
/// waiting. Throws Failure.
[[nodiscard]] std::unique_ptr<Display> openDisplay(const Config& config, double rateHz,
                                                   std::stop_token cancel,
                                                   const FileDisplayPolicy& policy = {});

/// Returns a copy of a picture, see copyPicture().
[[nodiscard]] ScreenPicture copyOf(const Picture& picture);

}  // namespace mfar
