#pragma once

#include "base/time.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace mfar {

/// Counts frames that a camera has not delivered: from the driver's frame numbers if there are any,
/// otherwise from the times of delivered frames. Numbers may wrap at 32 bits, restart, stand still
/// or be missing; times are used then. The period is the mean of the last intervals near their
/// median, so that gaps, jitter and rate changes have only a short effect.
class FrameDrops {
public:
    /// Adds a frame. Returns the number of frames missing since the previous one. From times: 0
    /// while the period is unknown (the first eight intervals) or when the time does not increase.
    int add(Timestamp time, std::optional<std::uint32_t> number = std::nullopt);
    /// Adds a frame whose time is meaningless: it is broken, or was triggered.
    int addUntimed(std::optional<std::uint32_t> number);
    /// Counts a delivered frame as dropped after all.
    void lose() { ++dropped_; }
    /// Ignores the next interval: the camera has been stopped.
    void pause();

    [[nodiscard]] std::uint64_t dropped() const { return dropped_; }
    /// Empty while unknown.
    [[nodiscard]] std::optional<std::chrono::nanoseconds> period() const;

private:
    [[nodiscard]] int missingByTime(Timestamp time);
    [[nodiscard]] std::optional<int> missingByNumber(std::optional<std::uint32_t> number);
    int count(int missing);

    static constexpr std::size_t kKept = 31;

    std::array<std::int64_t, kKept> intervals_{};  ///< [ns], a ring buffer
    std::size_t known_ = 0;
    std::size_t next_ = 0;
    std::optional<Timestamp> last_;
    std::optional<std::uint32_t> lastNumber_;
    int untimed_ = 0;  ///< frames since the last time
    int counted_ = 0;  ///< missing frames counted since the last time
    std::uint64_t dropped_ = 0;
};

}  // namespace mfar
