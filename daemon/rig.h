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

struct Recorded {
    std::filesystem::path folder;
    std::uint64_t video = 0;
    std::uint64_t stills = 0;
    std::uint64_t dropped = 0;
};

/// The recording of --record cannot be written.
class RecordingLost : public Failure {
public:
    explicit RecordingLost(const std::string& message) : Failure(ExitCode::OutputFailed, message) {}
};

/// The cameras, trigger line and recording of one run. Only the files rig* choose the
/// implementations of cameras, trigger and display.
class Rig {
public:
    /// Opens the configured source. Its threads register at `hearts`, which must outlive this
    /// object. Throws Failure.
    Rig(const Config& config, Heartbeats& hearts);
    explicit Rig(std::unique_ptr<RigSource> source);
    ~Rig();

    [[nodiscard]] const StereoRig& geometry() const;
    [[nodiscard]] Camera& video();
    [[nodiscard]] Camera& still();
    [[nodiscard]] Trigger* trigger();
    [[nodiscard]] HandOver handOver() const;
    [[nodiscard]] CameraKind cameraKind() const;
    /// Returns the offset that must be added to a still's time to get a time on the video camera's
    /// clock.
    [[nodiscard]] std::chrono::nanoseconds stillTimeOffset() const;
    [[nodiscard]] std::optional<std::uint64_t> videoFrames() const;
    /// Returns the source's geometry and frame rate, and the tags and poses that it has: those of a
    /// recording, or the tags of the simulated board. The result is valid as long as the rig
    /// exists.
    [[nodiscard]] PoseInputs poseInputs() const;
    /// Returns e.g. "synthetic:office: video 640x480 at 30 Hz, still 2304x1728".
    [[nodiscard]] std::string description() const;
    [[nodiscard]] std::optional<StillCounters> matching() const;
    [[nodiscard]] std::optional<std::string> fault() const;
    [[nodiscard]] ExitCode inputFailure() const;

    /// Copies a frame or a still into the recording, if one is running. If the source is lossless
    /// and the disk is slow, waits up to budget::kWriter. recordVideo() must always be called by
    /// the same thread, and so must recordStill(). The two threads may differ.
    void recordVideo(const Frame& frame);
    void recordStill(const Frame& frame);
    void recordPose(const Pose& pose);
    void recordTags(const TagMap& tags);
    /// Returns the number of frames and stills that are missing in this run's recordings.
    /// Thread-safe.
    [[nodiscard]] std::uint64_t notRecorded() const;
    /// Returns an empty path if there is no recording. Thread-safe.
    [[nodiscard]] std::filesystem::path recordingFolder() const;
    /// If the running recording cannot be written any more, ends it and returns the reason.
    /// Otherwise returns nothing. The part on the disk stays playable. Thread-safe. Never waits.
    [[nodiscard]] std::optional<std::string> endBrokenRecording();
    /// Returns why the recording of --record has ended too early, or nothing. Thread-safe.
    [[nodiscard]] std::optional<std::string> requiredFault() const;
    /// Waits until the whole recording is written. If this is the recording of --record and it
    /// cannot be written, throws RecordingLost. If another recording cannot be written,
    /// endBrokenRecording() reports that.
    void finishRecording();
    /// Returns a function that creates a recording in the new folder `folder`. The returned
    /// function may wait for the disk, throws Failure, and may outlive the rig. makeRecording()
    /// itself throws Failure while a recording is running. makeRecording(), startRecording() and
    /// stopRecording() are thread-safe.
    [[nodiscard]] std::function<std::shared_ptr<Recorder>()>
    makeRecording(const std::filesystem::path& folder) const;
    /// Records into `recorder` from now on. Throws Failure while a recording is running.
    void startRecording(std::shared_ptr<Recorder> recorder);
    /// Ends the recording. Returns a function that waits until the recording is complete on the
    /// disk. The returned function may outlive the rig, and throws Failure if the recording cannot
    /// be completed. stopRecording() itself throws Failure if no recording is running.
    [[nodiscard]] std::function<Recorded()> stopRecording();

private:
    [[nodiscard]] std::shared_ptr<Recorder> recorder() const;
    void requireNoRecorder() const;

    std::unique_ptr<RigSource> source_;
    RecorderOptions recording_;
    bool requiresNext_ = false;                 ///< true: the next recording is that of --record
    bool isRequired_ = false;                   ///< true: recorder_ is the recording of --record
    std::optional<std::string> requiredBroke_;  ///< fault that ended the recording of --record
    mutable std::mutex mutex_;
    std::shared_ptr<Recorder> recorder_;
    std::uint64_t lostBefore_ = 0;
    std::optional<std::string> broke_;
    std::vector<std::jthread> ending_;
};

/// Returns the path of a folder in `directory` that does not exist yet. Its name is the current
/// time (UTC).
[[nodiscard]] std::filesystem::path newRecordingIn(const std::filesystem::path& directory);

/// Opens the configured display. A stop request to `cancel` ends the display's waits. Throws
/// Failure.
[[nodiscard]] std::unique_ptr<Display> openDisplay(const Config& config, double rateHz,
                                                   std::stop_token cancel,
                                                   const FileDisplayPolicy& policy = {});

[[nodiscard]] ScreenPicture copyOf(const Picture& picture);

}  // namespace mfar
