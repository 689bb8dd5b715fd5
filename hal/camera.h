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
    std::string name;  ///< the name that messages use
    Size size;
    PixelFormat format = PixelFormat::Rgba8;
    double rateHz = 0;  ///< frame rate [Hz]; 0: the camera takes pictures on trigger only
};

/// Counts a camera's frames since its start. No frame is counted twice.
struct CameraCounters {
    std::uint64_t delivered = 0;
    /// Number of frames that the driver lost because it had no free buffer. Not set if the camera
    /// does not count them.
    std::optional<std::uint64_t> missed{};
    /// Number of frames that were not delivered because they are incomplete or the driver marked
    /// them as broken.
    std::uint64_t broken = 0;
    /// Number of frames that were not delivered because their timestamp is in the future, too old
    /// or out of order.
    std::uint64_t badTimes = 0;
    std::uint64_t startup = 0;   ///< number of frames before the sensor had settled; not delivered
    std::uint64_t untimed = 0;   ///< frames without a timestamp; their arrival time is used
    std::uint64_t restarts = 0;  ///< number of restarts after the driver cancelled all requests
    std::uint64_t reopened = 0;  ///< number of times that the device was opened again after a loss

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

/// Reports that the device was unplugged or failed. It must be opened again.
class DeviceLost : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// One image sensor that delivers frames. Constructors throw std::runtime_error if the device
/// cannot be opened. Only one thread calls next(); any thread may call stop().
class Camera {
public:
    virtual ~Camera() = default;

    [[nodiscard]] virtual CameraInfo info() const = 0;
    /// Begins delivery. Throws std::runtime_error.
    virtual void start() = 0;
    /// Waits up to `timeout` for the next frame and returns it. Returns nothing if no frame came or
    /// after stop(). Throws DeviceLost if the device was unplugged or failed.
    [[nodiscard]] virtual std::optional<Frame> next(std::chrono::milliseconds timeout) = 0;
    /// Ends delivery and wakes a waiting next(). Idempotent.
    virtual void stop() = 0;
    /// Returns whether no further frame will come, because a recording has ended. Always false for
    /// live cameras.
    [[nodiscard]] virtual bool ended() const = 0;

    /// Returns the counters of frames. They are all zero for a camera that cannot lose frames.
    /// Thread-safe.
    [[nodiscard]] virtual CameraCounters cameraCounters() const { return {}; }
    /// Returns the new warnings about the camera, while it works. Each warning is returned once.
    /// Thread-safe.
    [[nodiscard]] virtual std::vector<std::string> takeWarnings() { return {}; }
};

}  // namespace mfar
