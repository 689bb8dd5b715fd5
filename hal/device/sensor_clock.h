#pragma once

#include "base/time.h"

#include <cstdint>
#include <optional>

namespace mfar {

/// Converts a camera's timestamps to CLOCK_MONOTONIC. libcamera documents them as CLOCK_BOOTTIME,
/// but its drivers use CLOCK_MONOTONIC; the two differ by the machine's suspend time. Each of the
/// first eight frames is compared to both clocks: a time in the future on CLOCK_MONOTONIC but not
/// on CLOCK_BOOTTIME selects CLOCK_BOOTTIME; otherwise CLOCK_MONOTONIC is used.
class SensorClock {
public:
    enum class Kind : std::uint8_t { Monotonic, Boottime };

    struct Now {
        Timestamp monotonic;
        Timestamp boottime;

        [[nodiscard]] static Now read();
    };

    /// Empty when the time is implausible on both clocks: in the future, or more than ten seconds
    /// old.
    [[nodiscard]] std::optional<Timestamp> toMonotonic(Timestamp stamp, const Now& now);
    [[nodiscard]] Kind kind() const { return kind_; }

private:
    Kind kind_ = Kind::Monotonic;
    int compared_ = 0;
};

}  // namespace mfar
