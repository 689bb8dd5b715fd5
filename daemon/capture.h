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

/// A video frame, and the newest still that was exposed before it and has not been delivered yet.
struct CapturedFrame {
    Frame video;
    std::optional<CapturedStill> still;
    Timestamp arrived;                   ///< time of the frame's arrival, CLOCK_MONOTONIC
    std::optional<Pose> pose{};          ///< pose of the video frame
    std::uint64_t stillsSuperseded = 0;  ///< number of stills discarded because `still` is newer

    /// If this frame replaces a dropped frame and has no still, it gets the still of the dropped
    /// frame.
    void supersede(CapturedFrame&& older) {
        stillsSuperseded += older.stillsSuperseded;
        if (!still)
            still = std::move(older.still);
        else if (older.still)
            ++stillsSuperseded;
    }
};

/// Assigns stills to video frames by their times. Only one thread may use it.
class FramePairer {
public:
    /// Returns the next still that has arrived, or nothing. Must not wait.
    using NextStill = std::function<std::optional<CapturedStill>()>;

    explicit FramePairer(NextStill nextStill) : nextStill_(std::move(nextStill)) {}

    /// Takes all stills that are not later than the frame. Returns the frame with the newest of
    /// these stills.
    [[nodiscard]] CapturedFrame pair(Frame video, Timestamp arrived);

private:
    NextStill nextStill_;
    std::optional<CapturedStill> upcoming_;  ///< a still that is later than the last video frame
};

/// The thread that fetches frames from the rig's video camera, finds their poses and puts them into
/// the mailbox. So the search for tags runs in parallel with the GL thread's work on the previous
/// frame.
///
/// If a source is live, each camera has its own thread, so that the video continues if the still
/// camera hangs. If a source is lossless, this thread also reads the stills, in a reproducible
/// order.
class CaptureThread {
public:
    /// Starts the cameras and the thread. All arguments must outlive this object. Throws Failure.
    CaptureThread(Rig& rig, PoseFinder& poses, Stats& stats, Mailbox<CapturedFrame>& out);
    CaptureThread(const CaptureThread&) = delete;
    CaptureThread& operator=(const CaptureThread&) = delete;
    /// Waits for the threads, even for one that hangs in a camera.
    ~CaptureThread();

    /// Stops the cameras and closes the mailbox. Thread-safe and idempotent.
    void stop();
    /// Waits for the end of the thread, but not for a live camera that hangs. Must be called after
    /// stop(). Throws the error that ended the thread: Failure if a camera failed or a frame had a
    /// wrong size.
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
    CameraReader still_;  ///< used for a lossless source
    std::atomic<bool> stopped_{false};
    std::exception_ptr failure_;
    std::optional<StillThread> stills_;  ///< used for a live source
    std::promise<void> over_;
    std::future<void> isOver_;  ///< becomes ready when the thread has ended, see over_
    std::thread thread_;
};

}  // namespace mfar
