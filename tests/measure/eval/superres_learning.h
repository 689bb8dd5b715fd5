#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "tests/measure/eval/superres.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace mfar::eval {

/// SuperResRequest::learn: from each still of the recordings, once.
inline constexpr int kEachOnce = -1;

/// Filters learned from these recordings as the daemon learns them: each still is matched to the
/// frame nearest to it that does not show its very own view, those after the last one once more to
/// the frames next to these, up to request.learn matches. One line on what was learned goes to
/// stderr. Needs a current GL context.
[[nodiscard]] std::shared_ptr<const FilterBank>
learnedFilters(const SuperResRequest& request,
               const std::vector<std::filesystem::path>& recordings);

}  // namespace mfar::eval
