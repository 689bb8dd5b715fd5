#pragma once

#include <cstddef>
#include <vector>

namespace mfar::bench {

/// Summary of repeated timings [ms].
struct Summary {
    double median = 0;
    double p99 = 0;  ///< smallest time that at least 99 % of the runs do not exceed
    double min = 0;
    std::size_t runs = 0;
};

/// All members are zero if `ms` is empty.
[[nodiscard]] Summary summarise(std::vector<double> ms);

}  // namespace mfar::bench
