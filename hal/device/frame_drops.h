#pragma once

#include "base/time.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace mfar {

/// Counts frames that a camera with a steady rate has not delivered, from the times of those that
/// it has: sequence numbers can be reset. The period is the mean of the last intervals that are
/// near their median, so that neither gaps nor jitter nor a change of the rate matter for long.
class FrameDrops {
public:
    /// Returns how many frames are missing between the last one and this one. None while the period
    /// is not known (the first eight intervals), nor when the time does not rise.
    int add(Timestamp time);
    /// The next interval is none: the camera has been stopped.
    void pause() { last_.reset(); }

    [[nodiscard]] std::uint64_t dropped() const { return dropped_; }
    /// Nothing while it is not known.
    [[nodiscard]] std::optional<std::chrono::nanoseconds> period() const;

private:
    static constexpr std::size_t kKept = 31;

    std::array<std::int64_t, kKept> intervals_{};  ///< [ns], a ring
    std::size_t known_ = 0;
    std::size_t next_ = 0;
    std::optional<Timestamp> last_;
    std::uint64_t dropped_ = 0;
};

}  // namespace mfar
