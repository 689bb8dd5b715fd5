#pragma once

#include "base/heartbeats.h"
#include "daemon/mailbox.h"
#include "daemon/pose_finder.h"
#include "daemon/rig.h"
#include "daemon/stats.h"
#include "hal/camera.h"
#include "hal/frame.h"

#include <atomic>
#include <exception>
#include <functional>
#include <optional>
#include <thread>

namespace mfar {

/// A still and the video camera's pose at its time, where that is known.
struct CapturedStill {
    Frame frame;
    std::optional<Pose> pose{};
};

/// A video frame and the newest still that is not younger than it and has not been handed over.
struct CapturedFrame {
    Frame video;
    std::optional<CapturedStill> still;
    Timestamp arrived;           ///< in the daemon, CLOCK_MONOTONIC
    std::optional<Pose> pose{};  ///< of the video frame

    /// A dropped video frame must not take its still with it.
    void supersede(CapturedFrame&& older) {
        if (!still) still = std::move(older.still);
    }
};

/// Joins stills to video frames by their times. Used by one thread.
class FramePairer {
public:
    /// The next still that has come, or nothing; must not wait.
    using NextStill = std::function<std::optional<Frame>()>;

    explicit FramePairer(NextStill nextStill) : nextStill_(std::move(nextStill)) {}

    /// Takes stills as long as they are not younger than the frame; the newest of them goes along.
    [[nodiscard]] CapturedFrame pair(Frame video, Timestamp arrived);

private:
    NextStill nextStill_;
    std::optional<Frame> upcoming_;  ///< younger than the last video frame
};

/// The thread that fetches frames from the rig's cameras, has their poses found and hands them to
/// the mailbox. So tags are sought beside the GL thread's work on the frame before.
class CaptureThread {
public:
    /// Starts the cameras and the thread. All arguments must outlive this. Throws Failure.
    CaptureThread(Rig& rig, PoseFinder& poses, Stats& stats, Mailbox<CapturedFrame>& out);
    CaptureThread(const CaptureThread&) = delete;
    CaptureThread& operator=(const CaptureThread&) = delete;
    ~CaptureThread();

    /// Stops cameras and hand-over. Any thread, idempotent.
    void stop();
    /// Waits for the end of the thread. Throws what ended it: Failure for a camera that failed or
    /// a frame of a wrong size.
    void join();

private:
    void run();
    bool captureOne(FramePairer& pairer, Heartbeat& heart);
    std::optional<Frame> take(Camera& camera, std::chrono::milliseconds timeout, Size expected);
    void countGap(Timestamp time);

    Rig& rig_;
    PoseFinder& poses_;
    Stats& stats_;
    Mailbox<CapturedFrame>& out_;
    std::optional<Timestamp> lastVideo_;
    std::atomic<bool> stopped_{false};
    std::exception_ptr failure_;
    std::thread thread_;
};

}  // namespace mfar
