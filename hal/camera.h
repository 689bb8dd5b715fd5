#pragma once

#include "hal/frame.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace mfar {

struct CameraInfo {
    std::string name;  ///< for messages: the name a technician would use
    Size size;
    PixelFormat format = PixelFormat::Rgba8;
    double rateHz = 0;  ///< 0: on trigger only
};

/// Counts a camera's frames since its start. Each frame is counted in one place.
struct CameraCounters {
    std::uint64_t delivered = 0;
    /// Frames that the driver lost because it had no free buffer. Empty: the camera does not count.
    std::optional<std::uint64_t> missed{};
    std::uint64_t broken = 0;  ///< marked as broken by the driver, or incomplete; never delivered
    /// In the future, in the distant past or out of order; never delivered.
    std::uint64_t badTimes = 0;
    std::uint64_t startup = 0;   ///< frames from before the sensor had settled; never delivered
    std::uint64_t untimed = 0;   ///< frames without a driver timestamp; their arrival time is used
    std::uint64_t restarts = 0;  ///< restarts of a stream that had given up waiting for its sensor
    std::uint64_t reopened = 0;  ///< times that the device was lost

    CameraCounters& operator+=(const CameraCounters& other) {
        delivered += other.delivered;
        if (other.missed) missed = missed.value_or(0) + *other.missed;
        broken += other.broken;
        badTimes += other.badTimes;
        startup += other.startup;
        untimed += other.untimed;
        restarts += other.restarts;
        reopened += other.reopened;
        return *this;
    }
};

/// The device is gone and does not return by itself: it has to be opened again.
class DeviceLost : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// One image sensor that delivers frames. Constructors throw std::runtime_error when the device
/// cannot be opened. `next` is called from one thread; `stop` may be called from any.
class Camera {
public:
    virtual ~Camera() = default;

    [[nodiscard]] virtual CameraInfo info() const = 0;
    /// Begins delivery. Throws std::runtime_error.
    virtual void start() = 0;
    /// The next frame, waiting up to `timeout`; empty when none came or after stop(). Throws
    /// DeviceLost when the device was unplugged or failed.
    [[nodiscard]] virtual std::optional<Frame> next(std::chrono::milliseconds timeout) = 0;
    /// Ends delivery and wakes a waiting next(). Idempotent.
    virtual void stop() = 0;
    /// True when no further frame will come (end of a recording). Live cameras: false.
    [[nodiscard]] virtual bool ended() const = 0;

    /// All zero for a camera that cannot lose frames. Callable from any thread.
    [[nodiscard]] virtual CameraCounters cameraCounters() const { return {}; }
    /// Problems of a working device that users should know; each is returned once. Any thread.
    [[nodiscard]] virtual std::vector<std::string> takeWarnings() { return {}; }
};

}  // namespace mfar
