#pragma once

#include "daemon/exit_code.h"
#include "hal/camera.h"
#include "hal/frame.h"

#include <atomic>
#include <chrono>
#include <optional>

namespace mfar {

/// How soon it is told that a camera sends nothing. Stopping it wakes who waits at once.
inline constexpr std::chrono::milliseconds kFrameWait{50};

/// Fetches the frames of one camera and refuses those that cannot be its own. One thread.
class CameraReader {
public:
    /// `camera` must outlive this; its frames have the size `expected`; `failure` is what it means
    /// when the camera fails.
    CameraReader(Camera& camera, Size expected, ExitCode failure)
        : camera_(camera), expected_(expected), failure_(failure) {}

    /// See Camera. Throws Failure for a camera that fails and a frame of another size.
    [[nodiscard]] std::optional<Frame> next(std::chrono::milliseconds timeout);
    [[nodiscard]] bool ended() const { return camera_.ended(); }

    /// A call of next() waits for the camera. Any thread.
    [[nodiscard]] bool isWaiting() const { return waiting_; }

private:
    Camera& camera_;
    Size expected_;
    ExitCode failure_;
    std::atomic<bool> waiting_{false};
};

}  // namespace mfar
