#pragma once

#include "tests/measure/eval/report.h"
#include "tests/measure/eval/sample_run.h"

namespace mfar::eval {

/// Measures the requested methods on every sample of depthSamplesOf(). Throws EvalError,
/// RecordingError, TagMapError and ImageFileError.
[[nodiscard]] Report evaluateDepth(const SampleRequest& request);

}  // namespace mfar::eval
