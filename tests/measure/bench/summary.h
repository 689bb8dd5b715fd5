#pragma once

#include <cstddef>
#include <vector>

namespace mfar::bench {

/// Summary of repeated timings [ms].
struct Summary {
    double median = 0;
    double p99 = 0;  ///< smallest value that 99 % of the runs do not exceed
    double min = 0;
    std::size_t runs = 0;
};

/// All zero if there is no value.
[[nodiscard]] Summary summarise(std::vector<double> ms);

}  // namespace mfar::bench
