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

/// A video frame and the newest still that is not younger than it and has not been handed over.
struct CapturedFrame {
    Frame video;
    std::optional<CapturedStill> still;
    Timestamp arrived;                   ///< in the daemon, CLOCK_MONOTONIC
    std::optional<Pose> pose{};          ///< of the video frame
    std::uint64_t stillsSuperseded = 0;  ///< by `still`, which is newer

    /// A dropped video frame must not take its still with it.
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
    /// The next still that has come, or nothing; must not wait.
    using NextStill = std::function<std::optional<CapturedStill>()>;

    explicit FramePairer(NextStill nextStill) : nextStill_(std::move(nextStill)) {}

    /// Takes stills as long as they are not younger than the frame; the newest of them goes along.
    [[nodiscard]] CapturedFrame pair(Frame video, Timestamp arrived);

private:
    NextStill nextStill_;
    std::optional<CapturedStill> upcoming_;  ///< younger than the last video frame
};

/// The thread that fetches frames from the rig's video camera, has their poses found and hands them
/// to the mailbox. So tags are sought beside the GL thread's work on the frame before.
///
/// Live cameras have a thread each, so that the video goes on while the still camera hangs; a
/// source that loses nothing is read by this one thread, in an order that repeats.
class CaptureThread {
public:
    /// Starts the cameras and the thread. All arguments must outlive this. Throws Failure.
    CaptureThread(Rig& rig, PoseFinder& poses, Stats& stats, Mailbox<CapturedFrame>& out);
    CaptureThread(const CaptureThread&) = delete;
    CaptureThread& operator=(const CaptureThread&) = delete;
    /// Waits for the threads, and so for a camera that hangs.
    ~CaptureThread();

    /// Stops cameras and hand-over. Any thread, idempotent.
    void stop();
    /// Waits for the end of the thread, after stop(), but not for a live camera that does not
    /// answer. Throws what ended it: Failure for a camera that failed or a frame of a wrong size.
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
    CameraReader still_;  ///< of a source that loses nothing
    std::atomic<bool> stopped_{false};
    std::exception_ptr failure_;
    std::optional<StillThread> stills_;  ///< of a live source
    std::promise<void> over_;
    std::future<void> isOver_;  ///< of over_
    std::thread thread_;
};

}  // namespace mfar
