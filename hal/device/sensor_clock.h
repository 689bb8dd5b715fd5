#pragma once

#include "base/time.h"

#include <cstdint>
#include <optional>

namespace mfar {

/// Brings a camera's timestamps to CLOCK_MONOTONIC. libcamera documents them as CLOCK_BOOTTIME,
/// its drivers use CLOCK_MONOTONIC; the two differ by the time the machine has slept. Each frame of
/// the first eight is compared to both clocks: a frame that would be of the future on
/// CLOCK_MONOTONIC but not on CLOCK_BOOTTIME decides for this one, otherwise it is CLOCK_MONOTONIC.
class SensorClock {
public:
    enum class Kind : std::uint8_t { Monotonic, Boottime };

    struct Now {
        Timestamp monotonic;
        Timestamp boottime;

        [[nodiscard]] static Now read();
    };

    /// Nothing when the time is plausible on neither clock: of the future, or above ten seconds
    /// old.
    [[nodiscard]] std::optional<Timestamp> toMonotonic(Timestamp stamp, const Now& now);
    [[nodiscard]] Kind kind() const { return kind_; }

private:
    Kind kind_ = Kind::Monotonic;
    int compared_ = 0;
};

}  // namespace mfar
