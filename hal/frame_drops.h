#pragma once

#include "base/time.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace mfar {

/// Counts frames that a camera has not delivered: by the numbers that its driver gives frames,
/// where it gives some, otherwise by the times of those that came. Numbers may wrap at 32 bits,
/// begin anew, stand still or be missing, for which times stand in. The period is the mean of the
/// last intervals that are near their median, so that neither gaps nor jitter nor a change of the
/// rate matter for long.
class FrameDrops {
public:
    /// A frame. Returns how many are missing between the last one and this one. By times: none
    /// while the period is not known (the first eight intervals), nor when the time does not rise.
    int add(Timestamp time, std::optional<std::uint32_t> number = std::nullopt);
    /// A frame that came, but whose time means nothing: it is broken, or was triggered.
    int addUntimed(std::optional<std::uint32_t> number);
    /// A frame that had come is lost after all.
    void lose() { ++dropped_; }
    /// The next interval is none: the camera has been stopped.
    void pause();

    [[nodiscard]] std::uint64_t dropped() const { return dropped_; }
    /// Nothing while it is not known.
    [[nodiscard]] std::optional<std::chrono::nanoseconds> period() const;

private:
    [[nodiscard]] int missingByTime(Timestamp time);
    [[nodiscard]] std::optional<int> missingByNumber(std::optional<std::uint32_t> number);
    int count(int missing);

    static constexpr std::size_t kKept = 31;

    std::array<std::int64_t, kKept> intervals_{};  ///< [ns], a ring
    std::size_t known_ = 0;
    std::size_t next_ = 0;
    std::optional<Timestamp> last_;
    std::optional<std::uint32_t> lastNumber_;
    int untimed_ = 0;  ///< frames since the last time
    int counted_ = 0;  ///< missing ones since then
    std::uint64_t dropped_ = 0;
};

}  // namespace mfar
