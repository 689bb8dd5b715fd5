#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "tests/measure/eval/superres.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace mfar::eval {

/// Value of SuperResRequest::learn: learn from each still of the recordings once.
inline constexpr int kEachOnce = -1;

/// Learns filters from these recordings, as the daemon does. First each still is matched with its
/// nearest frame that does not show the same view, then with the next-nearest, and so on, until
/// request.learn matches are made. Prints one line on what was learned to stderr. Needs a current
/// GL context.
[[nodiscard]] std::shared_ptr<const FilterBank>
learnedFilters(const SuperResRequest& request,
               const std::vector<std::filesystem::path>& recordings);

}  // namespace mfar::eval
