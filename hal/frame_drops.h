#pragma once

#include "base/time.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace mfar {

/// Counts frames that a camera did not deliver. Normally, they are counted from gaps in the
/// driver's frame numbers. If the numbers are missing, restart or do not increase, drops are
/// counted from the times of the delivered frames. Numbers may wrap at 32 bits. To get the frame
/// period, recent intervals that are near their median are averaged. So gaps, jitter and changes of
/// the rate have only a short effect.
class FrameDrops {
public:
    /// Adds a frame and returns the number of frames that are missing since the previous one. If
    /// drops are counted from times, it is 0 while the period is unknown (the first eight
    /// intervals) and if the time does not increase.
    int add(Timestamp time, std::optional<std::uint32_t> number = std::nullopt);
    /// Adds a frame whose time must not be used, because the frame is broken or was triggered.
    /// Returns the number of frames that are missing since the previous one.
    int addUntimed(std::optional<std::uint32_t> number);
    /// Counts the last frame as dropped, because it could not be delivered.
    void lose() { ++dropped_; }
    /// Ignores the next interval, because the camera was stopped.
    void pause();

    [[nodiscard]] std::uint64_t dropped() const { return dropped_; }
    /// Returns the frame period, or nothing while it is unknown.
    [[nodiscard]] std::optional<std::chrono::nanoseconds> period() const;

private:
    [[nodiscard]] int missingByTime(Timestamp time);
    [[nodiscard]] std::optional<int> missingByNumber(std::optional<std::uint32_t> number);
    int count(int missing);

    static constexpr std::size_t kKept = 31;

    std::array<std::int64_t, kKept> intervals_{};  ///< ring buffer of intervals between frames [ns]
    std::size_t known_ = 0;
    std::size_t next_ = 0;
    std::optional<Timestamp> last_;
    std::optional<std::uint32_t> lastNumber_;
    int untimed_ = 0;  ///< number of frames since the last frame with a time
    int counted_ = 0;  ///< number of drops counted since the last frame with a time
    std::uint64_t dropped_ = 0;
};

}  // namespace mfar
