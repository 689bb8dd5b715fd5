#pragma once

#include "tests/measure/bench/bench.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace mfar::bench {

/// The whole result with times in ms. Sizes are written as [width, height].
[[nodiscard]] nlohmann::json toJson(const BenchResult& result);
/// A text for people: one line for each case, stage and peer.
[[nodiscard]] std::string toTable(const BenchResult& result);
/// Draws the times of whole frames, stages and peers as bars.
[[nodiscard]] std::string benchSvg(const BenchResult& result);

}  // namespace mfar::bench
