#pragma once

#include "base/time.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace mfar {

/// Counts frames that a camera did not deliver, from gaps in the driver's frame numbers. If the
/// numbers are missing or restart, drops are counted from the times of the delivered frames. For
/// this, the frame period is the mean of those recent intervals that are close to their median.
class FrameDrops {
public:
    /// Adds a frame and returns the number of frames missing before it. Without usable frame
    /// numbers, returns 0 until eight intervals between frames are known.
    int add(Timestamp time, std::optional<std::uint32_t> number = std::nullopt);
    /// Adds a frame whose time must not be used, because the frame is broken or was triggered.
    /// Returns the number of frames missing before it.
    int addUntimed(std::optional<std::uint32_t> number);
    void lose() { ++dropped_; }
    /// Ignores the next interval, because the camera was stopped.
    void pause();

    [[nodiscard]] std::uint64_t dropped() const { return dropped_; }
    [[nodiscard]] std::optional<std::chrono::nanoseconds> period() const;

private:
    [[nodiscard]] int missingByTime(Timestamp time);
    [[nodiscard]] std::optional<int> missingByNumber(std::optional<std::uint32_t> number);
    int count(int missing);

    static constexpr std::size_t kKept = 31;

    std::array<std::int64_t, kKept> intervals_{};
    std::size_t known_ = 0;
    std::size_t next_ = 0;
    std::optional<Timestamp> last_;
    std::optional<std::uint32_t> lastNumber_;
    int untimed_ = 0;
    int counted_ = 0;
    std::uint64_t dropped_ = 0;
};

}  // namespace mfar
