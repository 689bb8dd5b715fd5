#pragma once

#include "tests/eval/report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mfar::eval {

struct FlowRequest {
    std::vector<std::filesystem::path> folders;  ///< recordings or two-frame pairs
    std::vector<std::string> methods;            ///< of flowMethodNames()
    int frames = 0;                              ///< per folder, 0 = all that have truth
};

/// Measures every method on every pair of pictures with true flow; columns as in design.md, section
/// 10. `ms` is the median of three runs after one to warm up. Throws EvalError and RecordingError.
[[nodiscard]] Report evaluateFlow(const FlowRequest& request);

}  // namespace mfar::eval
