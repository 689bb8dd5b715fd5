#pragma once

#include "hal/frame.h"

#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>

namespace mfar {

struct CameraInfo {
    std::string name;  ///< for messages: what a technician would call it
    Size size;
    PixelFormat format = PixelFormat::Rgba8;
    double rateHz = 0;  ///< 0: on trigger only
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
};

}  // namespace mfar
