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
    /// A camera that sends no frame for this time is reported as silent. 0: the camera is
    /// triggered, and silence is normal.
    std::chrono::milliseconds silent{150};
    /// A camera that sends no frame for this time is closed and opened again.
    std::chrono::milliseconds stalled{2000};
    /// Pause between two attempts to open the device. It doubles with each attempt, from firstPause
    /// to longestPause. A camera that is plugged in again must work within 3 s, and some libraries
    /// need 2 s of these to find it. There is also a pause if a device was lost before it sent a
    /// frame.
    std::chrono::milliseconds firstPause{100}, longestPause{500};
    /// Returns whether frames may be late for a reason outside this device. Example: libcamera
    /// probes a newly plugged device in the thread that delivers the frames of all cameras.
    /// `excused` is used instead of `stalled` then. May be empty. Any thread may call it.
    std::function<bool()> busyElsewhere{};
    std::chrono::milliseconds excused{6000};
    /// The thread that opens, stops and closes the device. Its budget is for one such call. If a
    /// driver never returns from a call, only a restart of the process helps.
    WatchedThread opener{};
};

/// A camera that opens its device again when it is lost. A separate thread opens, stops and closes
/// the device, so that callers of next() do not wait for that. Only one thread may call next(); the
/// other functions are thread-safe. If a driver hangs, only next() and the destructor block, and
/// fault() reports it.
class ReopeningCamera final : public Camera {
public:
    /// Opens the device. Throws a std::exception if that fails.
    using Open = std::function<std::unique_ptr<Camera>()>;

    /// `info`: the expected camera. A device with another picture size counts as missing.
    ReopeningCamera(CameraInfo info, Open open, const ReopeningOptions& options);
    ReopeningCamera(const ReopeningCamera&) = delete;
    ReopeningCamera& operator=(const ReopeningCamera&) = delete;
    ~ReopeningCamera() override;

    [[nodiscard]] CameraInfo info() const override { return info_; }
    /// Starts the thread that opens the device. A missing device does not throw.
    void start() override;
    /// Never throws: a failed camera is closed and opened again.
    [[nodiscard]] std::optional<Frame> next(std::chrono::milliseconds timeout) override;
    void stop() override;
    [[nodiscard]] bool ended() const override { return false; }

    /// Returns why there are no frames, or nothing while there are frames.
    [[nodiscard]] std::optional<std::string> fault() const;
    /// Returns whether no device is open.
    [[nodiscard]] bool absent() const;
    /// Returns how often the device was lost since the start.
    [[nodiscard]] std::uint64_t losses() const;
    /// Returns the sums over all devices that were opened so far.
    [[nodiscard]] CameraCounters cameraCounters() const override;
    [[nodiscard]] std::vector<std::string> takeWarnings() override;

private:
    void keepOpen();
    void take(std::shared_ptr<Camera> camera);
    void sent();
    [[nodiscard]] bool hangs() const;
    [[nodiscard]] bool hasStalled();
    void lose(const std::string& reason);
    [[nodiscard]] std::shared_ptr<Camera> opened(std::chrono::milliseconds timeout);
    [[nodiscard]] std::shared_ptr<Camera> tryOpen();

    const CameraInfo info_;
    const Open open_;
    const ReopeningOptions options_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::shared_ptr<Camera> camera_;    ///< a running next() holds a reference, too
    std::optional<std::string> fault_;  ///< why there are no frames
    Timestamp opened_, lastFrame_;      ///< lastFrame_ is opened_ until the first frame comes
    std::uint64_t losses_ = 0;
    CameraCounters before_;  ///< sums over the lost devices
    std::vector<std::string> warnings_;
    std::shared_ptr<Camera> lost_;     ///< a lost device that must be closed
    std::optional<Timestamp> answer_;  ///< deadline of the running next(); not set: none is running
    std::optional<Timestamp> busy_;    ///< when opening, stopping or closing began; not set: idle
    bool hasSent_ = false;             ///< whether the current or last device has sent a frame
    bool stopped_ = false;
    std::thread opener_;
};

}  // namespace mfar
