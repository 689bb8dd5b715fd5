#pragma once

#include <algorithm>
#include <limits>

namespace mfar {

/// Decides at which ticks of a timer a repeated action is due. If the interval between two actions
/// is not a multiple of the ticks' period, the intervals vary, but their mean is the wanted one.
class DueTimes {
public:
    /// Must be called at each tick. Returns true at the first call, and then once per interval.
    /// `now` and `interval` [s].
    [[nodiscard]] bool isDue(double now, double interval) {
        // The timer of the ticks and the clock can differ a little.
        constexpr double kSlack = 0.02;
        due_ = std::min(due_, now + interval);
        if (now + kSlack < due_) return false;
        due_ += interval;
        if (due_ <= now) due_ = now + interval;
        return true;
    }

private:
    double due_ = -std::numeric_limits<double>::infinity();
};

}  // namespace mfar
