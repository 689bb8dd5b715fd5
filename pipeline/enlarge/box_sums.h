#pragma once

#include "base/image_view.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace mfar::enlarge {

/// Sums of a value over squares of pixels. Reading a sum takes the same time for squares of all
/// sizes.
class BoxSums {
public:
    template <class ValueAt>
    BoxSums(Size size, const ValueAt& valueAt)
        : size_(size), sums_(static_cast<std::size_t>(size.width + 1) * (size.height + 1)) {
        for (int y = 0; y < size.height; ++y) {
            double row = 0;
            for (int x = 0; x < size.width; ++x) {
                row += valueAt(x, y);
                sums_[index(x + 1, y + 1)] = sums_[index(x + 1, y)] + row;
            }
        }
    }
    /// Returns the sum over the square within `reach` pixels of (x, y). Pixels outside the picture
    /// are omitted.
    [[nodiscard]] double around(int x, int y, int reach) const {
        const int x0 = std::max(x - reach, 0), x1 = std::min(x + reach + 1, size_.width),
                  y0 = std::max(y - reach, 0), y1 = std::min(y + reach + 1, size_.height);
        return sums_[index(x1, y1)] - sums_[index(x0, y1)] - sums_[index(x1, y0)] +
               sums_[index(x0, y0)];
    }

private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * (size_.width + 1) + x;
    }

    Size size_;
    std::vector<double> sums_;
};

}  // namespace mfar::enlarge
