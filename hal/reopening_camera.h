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
    /// A camera that sends nothing for this long is reported as silent. 0: a triggered camera,
    /// whose silence is normal.
    std::chrono::milliseconds silent{150};
    /// A camera that is silent for this long is closed and opened again.
    std::chrono::milliseconds stalled{2000};
    /// Pause between two attempts to open the device; doubles from the first value to the second. A
    /// camera that is plugged in again should work within 3 s, of which some libraries need two to
    /// find it. Also used after a device that was lost before it had sent anything.
    std::chrono::milliseconds firstPause{100}, longestPause{500};
    /// True while frames may be late for a reason other than this device: libcamera probes a newly
    /// plugged device in the thread that delivers every camera's frames. Meanwhile `excused`
    /// replaces `stalled`. Empty: there is no such reason. Any thread.
    std::function<bool()> busyElsewhere{};
    std::chrono::milliseconds excused{6000};
    /// The thread that opens, stops and closes the device. Its budget is for one such call: if a
    /// driver never returns from it, only ending the process helps.
    WatchedThread opener{};
};

/// A camera that outlives its device: a thread of its own opens, stops and closes the device, and
/// opens it again whenever it is lost, so that callers of next() never wait for a missing device.
/// next() is called from one thread, the rest from any. A driver that hangs blocks only next() and
/// the destructor; fault() reports it.
class ReopeningCamera final : public Camera {
public:
    /// Opens the device; throws std::exception if that fails.
    using Open = std::function<std::unique_ptr<Camera>()>;

    /// `info`: the expected camera; a different device counts as missing.
    ReopeningCamera(CameraInfo info, Open open, const ReopeningOptions& options);
    ReopeningCamera(const ReopeningCamera&) = delete;
    ReopeningCamera& operator=(const ReopeningCamera&) = delete;
    ~ReopeningCamera() override;

    [[nodiscard]] CameraInfo info() const override { return info_; }
    /// Begins to open the device. Never throws for a missing device.
    void start() override;
    /// Never throws: a failed camera is closed and opened again.
    [[nodiscard]] std::optional<Frame> next(std::chrono::milliseconds timeout) override;
    void stop() override;
    [[nodiscard]] bool ended() const override { return false; }

    /// Message why there are no frames; empty while there are frames.
    [[nodiscard]] std::optional<std::string> fault() const;
    /// True while no device is open.
    [[nodiscard]] bool absent() const;
    /// Number of losses since the start.
    [[nodiscard]] std::uint64_t losses() const;
    /// Sums over all devices opened so far.
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
    std::shared_ptr<Camera> camera_;    ///< also held by a next() that waits in it
    std::optional<std::string> fault_;  ///< why there are no frames
    Timestamp opened_, lastFrame_;      ///< lastFrame_ = opened_ until there is a frame
    std::uint64_t losses_ = 0;
    CameraCounters before_;  ///< sum over lost devices
    std::vector<std::string> warnings_;
    std::shared_ptr<Camera> lost_;     ///< has to be closed
    std::optional<Timestamp> answer_;  ///< deadline of the current next(); empty: no call
    std::optional<Timestamp> busy_;    ///< start of the current opening or closing
    bool hasSent_ = false;             ///< whether the current or last device has sent a frame
    bool stopped_ = false;
    std::thread opener_;
};

}  // namespace mfar
