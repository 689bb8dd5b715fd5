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

/// A camera that sends nothing is reported after this time. Stopping it ends the wait at once.
inline constexpr std::chrono::milliseconds kFrameWait{50};

/// Fetches the frames of one camera of a rig, refuses those that cannot be its own and tells
/// `stats` how the camera is. One thread.
class CameraReader {
public:
    /// Both must outlive this.
    CameraReader(Rig& rig, CameraRole role, Stats& stats);

    /// See Camera. Throws Failure for a camera that fails and a frame of another size.
    [[nodiscard]] std::optional<Frame> next(std::chrono::milliseconds timeout);
    [[nodiscard]] bool ended() const { return camera_.ended(); }

    /// A call of next() waits for the camera. Any thread.
    [[nodiscard]] bool isWaiting() const { return waiting_; }

private:
    void tell();

    Camera& camera_;
    CameraRole role_;
    Size expected_;
    ExitCode failure_;  ///< what it means when the camera fails
    CameraWatch watch_;
    Stats& stats_;
    std::atomic<bool> waiting_{false};
};

}  // namespace mfar
