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

/// Longest wait for a frame, after which a camera's fault is reported. Stopping the camera ends the
/// wait at once.
inline constexpr std::chrono::milliseconds kFrameWait{50};

/// Fetches the frames of one camera of a rig, refuses frames with a wrong size and reports the
/// camera's state to `stats`. Used by one thread.
class CameraReader {
public:
    /// Both must outlive this.
    CameraReader(Rig& rig, CameraRole role, Stats& stats);

    /// See Camera. Throws Failure for a camera that fails and a frame of another size.
    [[nodiscard]] std::optional<Frame> next(std::chrono::milliseconds timeout);
    [[nodiscard]] bool ended() const { return camera_.ended(); }

    /// True while next() waits for the camera. Any thread.
    [[nodiscard]] bool isWaiting() const { return waiting_; }

private:
    void tell();

    Camera& camera_;
    CameraRole role_;
    Size expected_;
    ExitCode failure_;  ///< exit code when the camera fails
    CameraWatch watch_;
    Stats& stats_;
    std::atomic<bool> waiting_{false};
};

}  // namespace mfar
