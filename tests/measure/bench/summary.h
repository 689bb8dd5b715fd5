#pragma once

#include <cstddef>
#include <vector>

namespace mfar::bench {

struct Summary {
    double median = 0;
    double p99 = 0;  ///< at least 99 % of the runs take at most this time
    double min = 0;
    std::size_t runs = 0;
};

/// All members are zero if `ms` is empty.
[[nodiscard]] Summary summarise(std::vector<double> ms);

}  // namespace mfar::bench
