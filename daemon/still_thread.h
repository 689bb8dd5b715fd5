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

/// A still, with the pose that the video camera had at the time of the still, if that pose is
/// known.
struct CapturedStill {
    Frame frame;
    std::optional<Pose> pose{};
    std::optional<StillMeasurement> measured{};  ///< not set: not searched for tags yet
};

/// Returns the next still of a rig, or nothing after `timeout`. Counts and records the still. Its
/// time is converted to the video camera's clock. Throws Failure.
[[nodiscard]] std::optional<CapturedStill> nextStill(CameraReader& reader, Rig& rig, Stats& stats,
                                                     std::chrono::milliseconds timeout);

/// A queue of stills from the still camera's thread to the video camera's thread. It is short,
/// because each still occupies a buffer of the camera. Thread-safe. Never waits.
class StillBox {
public:
    static constexpr std::size_t kCapacity = 2;

    /// Stores a still. If the queue is full, drops its oldest still and returns false.
    bool put(CapturedStill still);
    [[nodiscard]] std::optional<CapturedStill> take();

private:
    std::mutex mutex_;
    std::deque<CapturedStill> stills_;
};

/// The thread that fetches stills from a live still camera. Another thread reads the video camera.
/// So neither the still camera nor the search for tags in a still delays the video.
class StillThread {
public:
    /// The caller must start the still camera before it creates this object, and stop the camera
    /// after it has called stop(). All arguments must outlive this object.
    StillThread(Rig& rig, PoseFinder& poses, Stats& stats);
    StillThread(const StillThread&) = delete;
    StillThread& operator=(const StillThread&) = delete;
    /// Waits until the thread has ended. The thread ends when its current call of the camera
    /// returns.
    ~StillThread();

    void stop() { stopped_ = true; }
    /// If an error ended the thread, throws that error: Failure if the camera failed or a still had
    /// a wrong size.
    void check() const;
    /// Returns the oldest still that has arrived, or nothing. Never waits.
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
    std::exception_ptr failure_;
    std::thread thread_;
};

}  // namespace mfar
