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

/// Pictures of a recording, by what became of them.
struct Recorded {
    std::uint64_t video = 0;
    std::uint64_t stills = 0;
    std::uint64_t dropped = 0;
};

/// The devices of one run. This is the one place that knows which kinds exist.
class Rig {
public:
    /// Opens the source that the configuration names. `hearts` watches its threads and must outlive
    /// this. Throws Failure.
    Rig(const Config& config, Heartbeats& hearts);
    /// Takes the devices as they are.
    explicit Rig(std::unique_ptr<RigSource> source);
    ~Rig();

    [[nodiscard]] const StereoRig& geometry() const;
    [[nodiscard]] Camera& video();
    [[nodiscard]] Camera& still();
    /// nullptr where stills come by themselves.
    [[nodiscard]] Trigger* trigger();
    [[nodiscard]] HandOver handOver() const;
    [[nodiscard]] CameraKind cameraKind() const;
    /// What brings a still's time to the video's clock.
    [[nodiscard]] std::chrono::nanoseconds stillTimeOffset() const;
    /// How many video frames there will be at most, where that is known.
    [[nodiscard]] std::optional<std::uint64_t> videoFrames() const;
    /// What is known about poses: a recording's tags.toml and poses, the synthetic board's tags.
    /// Valid as long as the rig. Throws Failure for a tags.toml that is wrong.
    [[nodiscard]] PoseInputs poseInputs() const;
    /// "synthetic office: video 640x480 at 30 Hz, still 2304x1728"
    [[nodiscard]] std::string description() const;
    /// How stills and pulses went together, where a line of ours triggers them.
    [[nodiscard]] std::optional<StillCounters> matching() const;
    /// What is wrong with a device that the rig waits for, for people; nothing when all is well.
    [[nodiscard]] std::optional<std::string> fault() const;
    /// What it means when a camera fails.
    [[nodiscard]] ExitCode inputFailure() const;

    /// Copies a frame into the recording, if there is one; never waits. Each is called from one
    /// thread.
    void recordVideo(const Frame& frame);
    void recordStill(const Frame& frame);
    /// The same with the pose of a frame.
    void recordPose(const Pose& pose);
    void recordTags(const TagMap& tags);
    /// Frames and stills that the recording misses. Any thread.
    [[nodiscard]] std::uint64_t notRecorded() const;
    /// What is recorded into; empty: nothing is. Any thread.
    [[nodiscard]] std::filesystem::path recordingFolder() const;
    /// Ends a recording that can no longer be written, and says why; what it has stays readable.
    /// Any thread, never waits.
    [[nodiscard]] std::optional<std::string> endBrokenRecording();
    /// Waits until everything is written. Throws Failure where --record asked for a recording that
    /// cannot be written; endBrokenRecording() tells it of others.
    void finishRecording();
    /// What is returned makes a recording in this new folder, which may wait for the disk, and
    /// throws Failure when it cannot; it may outlive this. Throws Failure when something is
    /// recorded already. Any thread, as the next two.
    [[nodiscard]] std::function<std::shared_ptr<Recorder>()>
    makeRecording(const std::filesystem::path& folder) const;
    /// Records into it from now on. Throws Failure as makeRecording().
    void startRecording(std::shared_ptr<Recorder> recorder);
    /// Ends the recording. What is returned waits until it is whole, and throws Failure when it
    /// cannot be; it may outlive this. Throws Failure when nothing is recorded.
    [[nodiscard]] std::function<Recorded()> stopRecording();

private:
    [[nodiscard]] std::shared_ptr<Recorder> recorder() const;
    void requireNoRecorder() const;

    std::unique_ptr<RigSource> source_;
    RecorderOptions recording_;
    bool mustRecord_ = false;
    mutable std::mutex mutex_;
    std::shared_ptr<Recorder> recorder_;
    std::uint64_t lostBefore_ = 0;      ///< not recorded, of recordings that have ended
    std::optional<std::string> broke_;  ///< why the last one ended by itself
    std::vector<std::jthread> ending_;  ///< wait for the disk of those
};

/// A folder for a recording that begins now, named by the time (UTC), that does not exist yet.
[[nodiscard]] std::filesystem::path newRecordingIn(const std::filesystem::path& directory);

/// Brings a trigger line to its safe level. Throws Failure.
void releaseTrigger(const TriggerLineConfig& line);

/// Opens the display that the configuration names. A request on `cancel` ends its waiting. Throws
/// Failure.
[[nodiscard]] std::unique_ptr<Display> openDisplay(const Config& config, double rateHz,
                                                   std::stop_token cancel,
                                                   const FileDisplayPolicy& policy = {});

/// A copy of a picture, see copyPicture().
[[nodiscard]] ScreenPicture copyOf(const Picture& picture);

}  // namespace mfar
