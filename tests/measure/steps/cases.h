#pragma once

#include "base/workers.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace mfar {

/// Something to measure. `make` sets it up for a number of threads; what it returns is timed.
struct BenchCase {
    std::string name;
    std::function<std::function<void()>(std::shared_ptr<Workers>)> make;
};

[[nodiscard]] std::vector<BenchCase> detailBenchCases();

/// All of them, in the order of the report.
[[nodiscard]] std::vector<BenchCase> benchCases();

}  // namespace mfar
