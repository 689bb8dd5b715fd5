#pragma once

#include "base/workers.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace mfar {

struct BenchCase {
    std::string name;
    std::function<std::function<void()>(std::shared_ptr<Workers>)> make;
};

[[nodiscard]] std::vector<BenchCase> detailBenchCases();

[[nodiscard]] std::vector<BenchCase> benchCases();

}  // namespace mfar
