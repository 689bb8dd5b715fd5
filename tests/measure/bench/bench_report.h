#pragma once

#include "tests/measure/bench/bench.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace mfar::bench {

[[nodiscard]] nlohmann::json toJson(const BenchResult& result);
[[nodiscard]] std::string toTable(const BenchResult& result);
[[nodiscard]] std::string benchSvg(const BenchResult& result);

}  // namespace mfar::bench
