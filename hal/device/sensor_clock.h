#pragma once

#include "base/time.h"

#include <cstdint>
#include <optional>

namespace mfar {

/// Converts a camera's timestamps to CLOCK_MONOTONIC. libcamera documents CLOCK_BOOTTIME, but the
/// known drivers use CLOCK_MONOTONIC. The clocks differ by the time for which the machine was
/// suspended. A camera counts as using CLOCK_MONOTONIC, unless one of its first eight timestamps is
/// in the future on CLOCK_MONOTONIC but not on CLOCK_BOOTTIME.
class SensorClock {
public:
    enum class Kind : std::uint8_t { Monotonic, Boottime };

    struct Now {
        Timestamp monotonic;
        Timestamp boottime;

        [[nodiscard]] static Now read();
    };

    /// Returns nothing if the timestamp is in the future or more than ten seconds old.
    [[nodiscard]] std::optional<Timestamp> toMonotonic(Timestamp stamp, const Now& now);
    [[nodiscard]] Kind kind() const { return kind_; }

private:
    Kind kind_ = Kind::Monotonic;
    int compared_ = 0;
};

}  // namespace mfar
