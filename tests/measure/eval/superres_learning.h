#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "tests/measure/eval/superres.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace mfar::eval {

/// Value of SuperResRequest::learn: learn from each still once.
inline constexpr int kEachOnce = -1;

/// Learns filters from recordings, as the daemon does. Each still is matched with the nearest frame
/// that shows another view, then with the next-nearest, until request.learn matches are made.
/// Prints one line to stderr that tells what was learned. Needs a current GL context.
[[nodiscard]] std::shared_ptr<const FilterBank>
learnedFilters(const SuperResRequest& request,
               const std::vector<std::filesystem::path>& recordings);

}  // namespace mfar::eval
