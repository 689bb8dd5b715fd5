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
    /// A camera that sends nothing for this long is called silent. 0: one that sends on trigger
    /// only, whose silence says nothing.
    std::chrono::milliseconds silent{150};
    /// A camera that is silent for this long is closed and opened again.
    std::chrono::milliseconds stalled{2000};
    /// Pause between two attempts to open it; doubles from the first to the second. A camera that
    /// is plugged in again is to be back within 3 s, of which some libraries take two to find it.
    /// After a device that was lost at once, before it had sent anything, as well.
    std::chrono::milliseconds firstPause{100}, longestPause{500};
    /// Says that frames may be late for a reason that is not this device's: libcamera looks at a
    /// device that was plugged in from the thread that delivers every camera's frames. Meanwhile
    /// `excused` stands for `stalled`. Empty: there is no such reason. Any thread.
    std::function<bool()> busyElsewhere{};
    std::chrono::milliseconds excused{6000};
    /// The thread that opens, stops and closes the device. Its budget is for one such call: a
    /// driver that does not return from it can only be left with the process.
    WatchedThread opener{};
};

/// A camera that outlives its device: it is opened, stopped and closed by a thread of its own,
/// again whenever it is lost, so that whoever asks for frames never waits for a device that is not
/// there. next() is called from one thread, the rest from any; of a driver that hangs only next()
/// and the destructor wait, and fault() says so.
class ReopeningCamera final : public Camera {
public:
    /// Opens the device and throws std::exception when it cannot be had.
    using Open = std::function<std::unique_ptr<Camera>()>;

    /// `info`: what the camera is to be; a device that is something else counts as not there.
    ReopeningCamera(CameraInfo info, Open open, const ReopeningOptions& options);
    ReopeningCamera(const ReopeningCamera&) = delete;
    ReopeningCamera& operator=(const ReopeningCamera&) = delete;
    ~ReopeningCamera() override;

    [[nodiscard]] CameraInfo info() const override { return info_; }
    /// Begins to open the device. Never throws for a device that is not there.
    void start() override;
    /// Never throws: a camera that fails is closed and opened again.
    [[nodiscard]] std::optional<Frame> next(std::chrono::milliseconds timeout) override;
    void stop() override;
    [[nodiscard]] bool ended() const override { return false; }

    /// Why there are no frames, for people; nothing as long as there are.
    [[nodiscard]] std::optional<std::string> fault() const;
    /// There is no open device at present.
    [[nodiscard]] bool absent() const;
    /// How often it was lost since the start.
    [[nodiscard]] std::uint64_t losses() const;
    /// Of all devices that it was, one after the other.
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
    std::shared_ptr<Camera> camera_;    ///< also held by a next() that waits for it
    std::optional<std::string> fault_;  ///< why there is none
    Timestamp opened_, lastFrame_;      ///< the latter as the former until there is one
    std::uint64_t losses_ = 0;
    CameraCounters before_;  ///< of the devices that were lost
    std::vector<std::string> warnings_;
    std::shared_ptr<Camera> lost_;     ///< to be closed
    std::optional<Timestamp> answer_;  ///< when next() was to have its frame; nothing: nobody asks
    std::optional<Timestamp> busy_;    ///< since when it is being opened or closed
    bool hasSent_ = false;             ///< the one that is open, or was last
    bool stopped_ = false;
    std::thread opener_;
};

}  // namespace mfar
