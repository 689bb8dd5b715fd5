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

/// A video frame. `still` is the newest still whose time is not later than the frame's; it is not
/// set if an earlier frame already has this still.
struct CapturedFrame {
    Frame video;
    std::optional<CapturedStill> still;
    Timestamp arrived;  ///< time of arrival, CLOCK_MONOTONIC
    std::optional<Pose> pose{};
    std::uint64_t stillsSuperseded = 0;

    /// Must be called if this frame replaces the dropped frame `older`. A frame without a still
    /// gets the still of the dropped frame.
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

    /// Fetches all stills that were exposed up to the time of the frame. Returns the frame together
    /// with the newest of these stills.
    [[nodiscard]] CapturedFrame pair(Frame video, Timestamp arrived);

private:
    NextStill nextStill_;
    std::optional<CapturedStill> upcoming_;  ///< a still that is later than the last video frame
};

/// The thread that fetches video frames, finds their poses and puts the frames into the mailbox.
/// With a live source, it searches the next frame for tags while the picture thread still works on
/// the previous one. With a lossless source, it fetches the next frame only when the picture thread
/// asks for it.
///
/// A live still camera is read by another thread, so that the video continues if the still camera
/// hangs. The stills of a lossless source are read by this thread, so that the order of frames and
/// stills is the same in each run.
class CaptureThread {
public:
    /// Starts the cameras and the thread. All arguments must outlive this object. Throws Failure.
    CaptureThread(Rig& rig, PoseFinder& poses, Stats& stats, Mailbox<CapturedFrame>& out);
    CaptureThread(const CaptureThread&) = delete;
    CaptureThread& operator=(const CaptureThread&) = delete;
    /// Waits until the threads have ended. If a thread hangs in a camera, this wait does not end.
    ~CaptureThread();

    /// Stops the cameras and closes the mailbox. Thread-safe; a second call does nothing.
    void stop();
    /// Waits until the thread has ended, but does not wait for a thread that hangs in a live
    /// camera. Must be called after stop(). Throws the error that ended the thread: Failure if a
    /// camera failed or a frame had a wrong size.
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
    CameraReader still_;  ///< used with a lossless source
    std::atomic<bool> stopped_{false};
    std::exception_ptr failure_;
    std::optional<StillThread> stills_;  ///< used with a live source
    std::promise<void> over_;
    std::future<void> isOver_;
    std::thread thread_;
};

}  // namespace mfar
