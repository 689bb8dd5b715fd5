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
    std::string name;  ///< for messages: what a technician would call it
    Size size;
    PixelFormat format = PixelFormat::Rgba8;
    double rateHz = 0;  ///< 0: on trigger only
};

/// What became of a camera's frames since its start. Each is counted in one place.
struct CameraCounters {
    std::uint64_t delivered = 0;
    /// Frames that its driver lost: it had no buffer to fill. Nothing: the camera does not count.
    std::optional<std::uint64_t> missed{};
    std::uint64_t broken = 0;    ///< marked by the driver, or not whole; never delivered
    std::uint64_t badTimes = 0;  ///< of the future, the distant past, out of order; not delivered
    std::uint64_t startup = 0;   ///< from before the sensor had settled; never delivered
    std::uint64_t untimed = 0;   ///< without a time of the driver: that of their arrival is used
    std::uint64_t restarts = 0;  ///< of its stream, after it had given up waiting for its sensor
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

/// The device has gone and won't come back by itself: open it again.
class DeviceLost : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// One image sensor that delivers frames. Constructors throw std::runtime_error when the device
/// cannot be had. `next` is called from one thread; `stop` may be called from any.
class Camera {
public:
    virtual ~Camera() = default;

    [[nodiscard]] virtual CameraInfo info() const = 0;
    /// Begins delivery. Throws std::runtime_error.
    virtual void start() = 0;
    /// The next frame, waiting up to `timeout`; nothing when none came or after stop(). Throws
    /// DeviceLost when the device is unplugged or failed.
    [[nodiscard]] virtual std::optional<Frame> next(std::chrono::milliseconds timeout) = 0;
    /// Ends delivery and wakes a waiting next(). Idempotent.
    virtual void stop() = 0;
    /// True once no further frame will ever come (end of a recording). Live cameras: false.
    [[nodiscard]] virtual bool ended() const = 0;

    /// All zero for a camera that cannot lose frames. Any thread.
    [[nodiscard]] virtual CameraCounters cameraCounters() const { return {}; }
    /// What people should know about the device although it works; each once. Any thread.
    [[nodiscard]] virtual std::vector<std::string> takeWarnings() { return {}; }
};

}  // namespace mfar
