#pragma once

#include "tests/measure/bench/bench.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace mfar::bench {

/// Times are in ms, sizes are [width, height].
[[nodiscard]] nlohmann::json toJson(const BenchResult& result);
[[nodiscard]] std::string toTable(const BenchResult& result);
[[nodiscard]] std::string benchSvg(const BenchResult& result);

}  // namespace mfar::bench
