#include "hal/device/frame_drops.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace mfar {
namespace {

constexpr std::size_t kNeeded = 8;
/// A longer silence is a camera that stood still, not one that dropped frames.
constexpr double kMostMissing = 1000;

}  // namespace

std::optional<std::chrono::nanoseconds> FrameDrops::period() const {
    if (known_ < kNeeded) return std::nullopt;
    std::array<std::int64_t, kKept> sorted = intervals_;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(known_ / 2);
    std::nth_element(sorted.begin(), middle, sorted.begin() + static_cast<std::ptrdiff_t>(known_));
    // The jitter of times that follow each other cancels in the mean, not in the median.
    std::int64_t sum = 0;
    std::int64_t usual = 0;
    for (std::size_t i = 0; i < known_; ++i) {
        if (std::abs(intervals_[i] - *middle) > *middle / 2) continue;
        sum += intervals_[i];
        ++usual;
    }
    return std::chrono::nanoseconds{sum / usual};
}

int FrameDrops::add(Timestamp time) {
    const std::optional<Timestamp> last = last_;
    last_ = time;
    if (!last || time <= *last) return 0;
    const std::int64_t interval = (time - *last).count();
    const auto usual = period();
    intervals_[next_] = interval;
    next_ = (next_ + 1) % kKept;
    known_ = std::min(known_ + 1, kKept);
    if (!usual) return 0;
    const double steps = std::round(static_cast<double>(interval) / usual->count());
    if (!(steps >= 2 && steps <= kMostMissing)) return 0;
    const int missing = static_cast<int>(steps) - 1;
    dropped_ += static_cast<std::uint64_t>(missing);
    return missing;
}

}  // namespace mfar
