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
    std::string name;
    Size size;
    PixelFormat format = PixelFormat::Rgba8;
    double rateHz = 0;  ///< frame rate [Hz]; 0: the camera takes pictures only when it is triggered
};

/// Counts a camera's frames, restarts and reopenings since its first start. A frame in `untimed` is
/// also counted in `delivered`. All other frames are counted once.
struct CameraCounters {
    std::uint64_t delivered = 0;
    /// Frames that the driver lost or that were skipped, e.g. because no buffer was free. Not set
    /// if the camera does not count them.
    std::optional<std::uint64_t> missed{};
    /// Frames that were not delivered, because they are incomplete, marked as broken by the driver,
    /// or cannot be decoded.
    std::uint64_t broken = 0;
    /// Frames that were not delivered, because their timestamp is in the future, too old or out of
    /// order.
    std::uint64_t badTimes = 0;
    /// Frames that were not delivered, because the sensor had not settled.
    std::uint64_t startup = 0;
    /// Delivered frames to which the driver gave no timestamp. They got their arrival time.
    std::uint64_t untimed = 0;
    std::uint64_t restarts = 0;  ///< restarts of the stream after the driver cancelled all requests
    std::uint64_t reopened = 0;

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
    virtual void start() = 0;
    /// Waits up to `timeout` for the next frame. Returns nothing if no frame came or after stop().
    /// Throws DeviceLost if the device was unplugged or failed.
    [[nodiscard]] virtual std::optional<Frame> next(std::chrono::milliseconds timeout) = 0;
    /// Ends delivery and wakes a waiting next(). Idempotent.
    virtual void stop() = 0;
    /// Returns true if a recording has ended, so that no further frame will come.
    [[nodiscard]] virtual bool ended() const = 0;

    /// Returns true if no frame is due now: a recording with a gap, played in real time.
    /// Thread-safe.
    [[nodiscard]] virtual bool isEarly() const { return false; }
    /// Thread-safe. All counters are zero for a camera that does not count its frames.
    [[nodiscard]] virtual CameraCounters cameraCounters() const { return {}; }
    /// Returns the warnings since the last call. Thread-safe.
    [[nodiscard]] virtual std::vector<std::string> takeWarnings() { return {}; }
};

}  // namespace mfar
