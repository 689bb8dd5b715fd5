#pragma once

#include "daemon/camera_watch.h"
#include "daemon/exit_code.h"
#include "daemon/rig.h"
#include "daemon/stats.h"
#include "hal/camera.h"
#include "hal/frame.h"

#include <atomic>
#include <chrono>
#include <optional>

namespace mfar {

/// Longest wait for a frame. After each wait, faults of the camera are reported. Camera::stop()
/// ends a wait at once.
inline constexpr std::chrono::milliseconds kFrameWait{50};

/// Fetches the frames of one camera of a rig, refuses frames of a wrong size, and reports the
/// camera's state to `stats`. Except for isWaiting(), only one thread may use it.
class CameraReader {
public:
    /// `rig` and `stats` must outlive this object.
    CameraReader(Rig& rig, CameraRole role, Stats& stats);

    /// Returns the next frame, see Camera::next(). Throws Failure if the camera fails or if the
    /// frame's size is not the one in the calibration.
    [[nodiscard]] std::optional<Frame> next(std::chrono::milliseconds timeout);
    [[nodiscard]] bool ended() const { return camera_.ended(); }

    /// Returns true while next() waits for the camera. Thread-safe.
    [[nodiscard]] bool isWaiting() const { return waiting_; }

private:
    void tell();

    Camera& camera_;
    CameraRole role_;
    Size expected_;
    ExitCode failure_;
    CameraWatch watch_;
    Stats& stats_;
    std::atomic<bool> waiting_{false};
};

}  // namespace mfar
