#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace mfar::eval {

/// A logarithmic axis that spans all values that were passed to include(). They must be above 0.
class LogAxis {
public:
    void include(double value) {
        least_ = std::min(least_, value);
        most_ = std::max(most_, value);
    }
    /// Position of a value on the axis, from 0 to 1. Both ends have a margin without values.
    [[nodiscard]] double at(double value) const {
        if (!(least_ <= most_)) return 0;
        return (std::log(value / least_) + kMargin) / (std::log(most_ / least_) + 2 * kMargin);
    }
    [[nodiscard]] std::vector<double> ticks() const {
        const bool isShort = most_ < 10 * least_, isLong = most_ > 1000 * least_;
        std::vector<double> out;
        for (int power = -9; power <= 9; ++power)
            for (const double digit : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0})
                if (isShort || digit == 1 || (!isLong && (digit == 2 || digit == 5))) {
                    const double v = digit * std::pow(10, power), where = at(v);
                    if (where > 0 && where < 1) out.push_back(v);
                }
        return out;
    }

private:
    static constexpr double kMargin = 0.12;

    double least_ = 1e300, most_ = 0;
};

}  // namespace mfar::eval
