#pragma once

#include "base/heartbeats.h"
#include "daemon/camera_reader.h"
#include "daemon/mailbox.h"
#include "daemon/pose_finder.h"
#include "daemon/rig.h"
#include "daemon/stats.h"
#include "daemon/still_thread.h"
#include "hal/frame.h"

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <future>
#include <optional>
#include <thread>

namespace mfar {

/// A video frame, together with the newest still that is not younger than it and has not been
/// handed over.
struct CapturedFrame {
    Frame video;
    std::optional<CapturedStill> still;
    Timestamp arrived;                   ///< in the daemon, CLOCK_MONOTONIC
    std::optional<Pose> pose{};          ///< of the video frame
    std::uint64_t stillsSuperseded = 0;  ///< superseded by `still`, which is newer

    /// When this frame replaces a dropped one, it takes over the dropped frame's still.
    void supersede(CapturedFrame&& older) {
        stillsSuperseded += older.stillsSuperseded;
        if (!still)
            still = std::move(older.still);
        else if (older.still)
            ++stillsSuperseded;
    }
};

/// Joins stills to video frames by their times. Used by one thread.
class FramePairer {
public:
    /// Returns the next still that has come, or nothing; must not wait.
    using NextStill = std::function<std::optional<CapturedStill>()>;

    explicit FramePairer(NextStill nextStill) : nextStill_(std::move(nextStill)) {}

    /// Takes all stills that are not younger than the frame and hands over the newest of them.
    [[nodiscard]] CapturedFrame pair(Frame video, Timestamp arrived);

private:
    NextStill nextStill_;
    std::optional<CapturedStill> upcoming_;  ///< a still younger than the last video frame
};

/// The thread that fetches frames from the rig's video camera, has their poses found and hands them
/// to the mailbox. The search for tags thus runs in parallel with the GL thread's work on the
/// previous frame.
///
/// Each live camera has a thread of its own, so that the video goes on while the still camera
/// hangs. A lossless source is read by this one thread, in a reproducible order.
class CaptureThread {
public:
    /// Starts the cameras and the thread. All arguments must outlive this. Throws Failure.
    CaptureThread(Rig& rig, PoseFinder& poses, Stats& stats, Mailbox<CapturedFrame>& out);
    CaptureThread(const CaptureThread&) = delete;
    CaptureThread& operator=(const CaptureThread&) = delete;
    /// Waits for the threads, even for a camera that hangs.
    ~CaptureThread();

    /// Stops the cameras and the mailbox. Any thread, idempotent.
    void stop();
    /// Waits for the end of the thread, after stop(), but not for a live camera that does not
    /// answer. Throws the error that ended the thread: Failure for a camera that failed or a frame
    /// of a wrong size.
    void join();

private:
    void run();
    [[nodiscard]] FramePairer::NextStill stillSource();
    bool captureOne(FramePairer& pairer, Heartbeat& heart);

    Rig& rig_;
    PoseFinder& poses_;
    Stats& stats_;
    Mailbox<CapturedFrame>& out_;
    CameraReader video_;
    CameraReader still_;  ///< for a lossless source
    std::atomic<bool> stopped_{false};
    std::exception_ptr failure_;
    std::optional<StillThread> stills_;  ///< for a live source
    std::promise<void> over_;
    std::future<void> isOver_;  ///< the future of over_
    std::thread thread_;
};

}  // namespace mfar
