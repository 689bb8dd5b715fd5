#pragma once

#include "base/time.h"
#include "hal/device/sensor_clock.h"
#include "hal/frame_drops.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace mfar {

/// Decides which pictures of a camera's completed requests can be used, determines the times of
/// these pictures, and counts the others. Only one thread at a time may use it.
class PictureTimes {
public:
    /// A driver's report about a picture.
    struct Reported {
        bool isStartup = false;  ///< the sensor has just started; the picture is not to be used
        bool failed = false;
        std::size_t bytes = 0;  ///< in all planes
        std::uint32_t sequence = 0;
        /// Start of the first row's exposure [ns], on the clock that SensorClock detects; 0:
        /// unknown.
        std::int64_t stamp = 0;
        std::chrono::microseconds exposure{0};
    };

    struct Counters {
        std::uint64_t startup = 0, broken = 0, badTimes = 0, untimed = 0;
    };

    /// Pictures with fewer than `leastBytes` bytes are broken. `rateHz` 0: the camera is triggered,
    /// so the times of its pictures do not show drops.
    PictureTimes(std::size_t leastBytes, double rateHz)
        : leastBytes_(leastBytes), rateHz_(rateHz) {}

    /// Returns the middle of the picture's exposure. Returns the time of arrival if the driver
    /// reports no time stamp. Returns nothing if the picture must not be used.
    [[nodiscard]] std::optional<Timestamp> add(const Reported& picture,
                                               const SensorClock::Now& arrived);
    /// Must be called when the camera starts again.
    void pause() { drops_.pause(); }

    [[nodiscard]] const Counters& counters() const { return counters_; }
    [[nodiscard]] std::uint64_t dropped() const { return drops_.dropped(); }
    [[nodiscard]] SensorClock::Kind clock() const { return clock_.kind(); }

private:
    [[nodiscard]] bool isSound(const Reported& picture);

    std::size_t leastBytes_;
    double rateHz_;
    Counters counters_;
    FrameDrops drops_;
    SensorClock clock_;
    std::optional<Timestamp> last_;
};

}  // namespace mfar
