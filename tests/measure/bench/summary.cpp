#include "tests/measure/bench/summary.h"

#include <algorithm>
#include <cmath>

namespace mfar::bench {

Summary summarise(std::vector<double> ms) {
    if (ms.empty()) return {};
    std::sort(ms.begin(), ms.end());
    const std::size_t n = ms.size(), middle = n / 2;
    const double median = n % 2 == 1 ? ms[middle] : (ms[middle - 1] + ms[middle]) / 2;
    const auto rank = static_cast<std::size_t>(std::ceil(0.99 * static_cast<double>(n)));
    return {median, ms[rank - 1], ms.front(), n};
}

}  // namespace mfar::bench
