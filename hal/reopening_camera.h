#pragma once

#include "base/heartbeats.h"
#include "hal/camera.h"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace mfar {

struct ReopeningOptions {
    /// If the camera sends no frame for this time, it is reported as silent. 0: the camera is
    /// triggered and may be silent.
    std::chrono::milliseconds silent{150};
    /// If the camera sends no frame for this time, it is closed and opened again, unless `silent`
    /// is 0.
    std::chrono::milliseconds stalled{2000};
    /// Pause between two attempts to open the device. It doubles with each attempt, from firstPause
    /// to longestPause. A camera must work within 3 s after it is plugged in, although some
    /// libraries find it only after 2 s.
    std::chrono::milliseconds firstPause{100}, longestPause{500};
    /// Returns true while frames may be late for a reason outside this device. Then the
    /// longer of `excused` and `stalled` is used. Example: libcamera probes a new device in the
    /// thread that delivers all frames. May be empty. The thread of next() calls this function.
    std::function<bool()> busyElsewhere{};
    std::chrono::milliseconds excused{6000};
    WatchedThread opener{};
};

/// A camera that opens its device again after the device was lost. A separate thread opens, stops
/// and closes the device. Only one thread may call next(); the other functions are thread-safe. If
/// a driver hangs, only next() and the destructor block.
class ReopeningCamera final : public Camera {
public:
    using Open = std::function<std::unique_ptr<Camera>()>;

    /// `info` describes the expected camera. A device with another picture size counts as missing.
    ReopeningCamera(CameraInfo info, Open open, const ReopeningOptions& options);
    ReopeningCamera(const ReopeningCamera&) = delete;
    ReopeningCamera& operator=(const ReopeningCamera&) = delete;
    ~ReopeningCamera() override;

    [[nodiscard]] CameraInfo info() const override { return info_; }
    /// Starts the thread that opens the device. Does not throw if the device is missing.
    void start() override;
    /// Never throws. If the device fails, it is closed and opened again.
    [[nodiscard]] std::optional<Frame> next(std::chrono::milliseconds timeout) override;
    void stop() override;
    [[nodiscard]] bool ended() const override { return false; }

    /// Makes the opener's thread close the device if it is open, and open it again. Does not wait.
    /// `reason` becomes the fault.
    void reopen(const std::string& reason);

    [[nodiscard]] std::optional<std::string> fault() const;
    [[nodiscard]] bool absent() const;
    [[nodiscard]] std::uint64_t losses() const;
    [[nodiscard]] CameraCounters cameraCounters() const override;
    [[nodiscard]] std::vector<std::string> takeWarnings() override;

private:
    void keepOpen();
    void take(std::shared_ptr<Camera> camera);
    void sent();
    [[nodiscard]] bool hangs() const;
    [[nodiscard]] bool hasStalled();
    [[nodiscard]] std::shared_ptr<Camera> opened(std::chrono::milliseconds timeout);
    [[nodiscard]] std::shared_ptr<Camera> tryOpen();

    const CameraInfo info_;
    const Open open_;
    const ReopeningOptions options_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::shared_ptr<Camera> camera_;
    std::optional<std::string> fault_;
    Timestamp opened_, lastFrame_;
    std::uint64_t losses_ = 0;
    CameraCounters before_;
    std::vector<std::string> warnings_;
    std::shared_ptr<Camera> lost_;
    /// Deadline of the running next(). Not set while next() is not running.
    std::optional<Timestamp> answer_;
    /// Start of the running call that opens, stops or closes the device. Not set: no such call
    /// runs.
    std::optional<Timestamp> busy_;
    bool hasSent_ = false;
    bool stopped_ = false;
    std::thread opener_;
};

}  // namespace mfar
