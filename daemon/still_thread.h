#pragma once

#include "daemon/camera_reader.h"
#include "daemon/pose_finder.h"
#include "daemon/rig.h"
#include "daemon/stats.h"
#include "hal/frame.h"

#include <atomic>
#include <cstddef>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

namespace mfar {

/// A still and the video camera's pose at its time, where that is known.
struct CapturedStill {
    Frame frame;
    std::optional<Pose> pose{};
    std::optional<StillMeasurement> measured{};  ///< nothing: not measured yet
};

/// The next still of a rig as FramePairer expects it: its time converted to the video's clock,
/// counted and recorded. Nothing when none has come within `timeout`. Throws Failure.
[[nodiscard]] std::optional<CapturedStill> nextStill(CameraReader& reader, Rig& rig, Stats& stats,
                                                     std::chrono::milliseconds timeout);

/// Stills on their way from the still camera's thread to the video's, oldest first. The capacity is
/// small, as each still holds a buffer of the camera. Thread-safe, never waits.
class StillBox {
public:
    static constexpr std::size_t kCapacity = 2;

    /// False: the oldest still was dropped to make room.
    bool put(CapturedStill still);
    [[nodiscard]] std::optional<CapturedStill> take();

private:
    std::mutex mutex_;
    std::deque<CapturedStill> stills_;
};

/// The thread of a live still camera, so that neither a camera that hangs nor the search for tags
/// in a still delays the video.
class StillThread {
public:
    /// The camera has been started; the owner stops it. All arguments must outlive this.
    StillThread(Rig& rig, PoseFinder& poses, Stats& stats);
    StillThread(const StillThread&) = delete;
    StillThread& operator=(const StillThread&) = delete;
    /// Waits for the thread, which ends with the camera's next answer.
    ~StillThread();

    /// Ends the thread with the camera's next answer. Any thread, never waits.
    void stop() { stopped_ = true; }
    /// Throws the error that ended the thread: Failure for a camera that failed or a still of a
    /// wrong size.
    void check() const;
    /// The next still, if one has come. Never waits.
    [[nodiscard]] std::optional<CapturedStill> take() { return box_.take(); }

private:
    void run();

    Rig& rig_;
    PoseFinder& poses_;
    Stats& stats_;
    CameraReader reader_;
    StillBox box_;
    std::atomic<bool> stopped_{false};
    std::atomic<bool> failed_{false};
    std::exception_ptr failure_;  ///< written before failed_
    std::thread thread_;
};

}  // namespace mfar
