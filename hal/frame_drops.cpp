#include "hal/frame_drops.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace mfar {
namespace {

constexpr std::size_t kNeeded = 8;
/// If an interval between two frames is longer than this number of frame periods, no drops are
/// counted: the camera was probably stopped.
constexpr double kMostMissing = 1000;
/// Limits for the jump from one of the driver's frame numbers to the next. The numbers count as
/// restarted if the jump is above kMostNumbers, or above about kDoubtful times the number of frame
/// periods that have passed.
constexpr std::uint32_t kMostNumbers = 10000;
constexpr int kDoubtful = 8;

}  // namespace

std::optional<std::chrono::nanoseconds> FrameDrops::period() const {
    if (known_ < kNeeded) return std::nullopt;
    std::array<std::int64_t, kKept> sorted = intervals_;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(known_ / 2);
    std::nth_element(sorted.begin(), middle, sorted.begin() + static_cast<std::ptrdiff_t>(known_));
    // The mean is more accurate than the median, because the jitter of consecutive timestamps
    // cancels in the mean.
    std::int64_t sum = 0;
    std::int64_t usual = 0;
    for (std::size_t i = 0; i < known_; ++i) {
        if (std::abs(intervals_[i] - *middle) > *middle / 2) continue;
        sum += intervals_[i];
        ++usual;
    }
    return std::chrono::nanoseconds{sum / usual};
}

int FrameDrops::missingByTime(Timestamp time) {
    const std::optional<Timestamp> last = last_;
    last_ = time;
    if (!last || time <= *last) return 0;
    const std::int64_t interval = (time - *last).count();
    const auto usual = period();
    intervals_[next_] = interval / (1 + untimed_);
    next_ = (next_ + 1) % kKept;
    known_ = std::min(known_ + 1, kKept);
    if (!usual) return 0;
    const double steps = std::round(static_cast<double>(interval) / usual->count());
    if (!(steps >= 2 && steps <= kMostMissing)) return 0;
    return std::max(static_cast<int>(steps) - 1 - untimed_ - counted_, 0);
}

std::optional<int> FrameDrops::missingByNumber(std::optional<std::uint32_t> number) {
    const std::optional<std::uint32_t> last = lastNumber_;
    lastNumber_ = number;
    if (!number || !last) return std::nullopt;
    // Unsigned subtraction is correct even if the driver's counter has wrapped around.
    const std::uint32_t step = *number - *last;
    if (step == 0 || step > kMostNumbers) return std::nullopt;
    return static_cast<int>(step) - 1;
}

int FrameDrops::count(int missing) {
    dropped_ += static_cast<std::uint64_t>(missing);
    return missing;
}

int FrameDrops::add(Timestamp time, std::optional<std::uint32_t> number) {
    const bool periodKnown = known_ >= kNeeded && last_;
    const int byTime = missingByTime(time);
    untimed_ = counted_ = 0;
    const std::optional<int> byNumber = missingByNumber(number);
    if (!byNumber || (periodKnown && *byNumber > kDoubtful * (byTime + 2))) return count(byTime);
    return count(*byNumber);
}

int FrameDrops::addUntimed(std::optional<std::uint32_t> number) {
    const int missing = missingByNumber(number).value_or(0);
    ++untimed_;
    counted_ += missing;
    return count(missing);
}

void FrameDrops::pause() {
    last_.reset();
    lastNumber_.reset();
    untimed_ = counted_ = 0;
}

}  // namespace mfar
