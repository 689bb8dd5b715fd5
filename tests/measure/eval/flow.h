#pragma once

#include "tests/measure/eval/report.h"
#include "tests/measure/eval/sample_run.h"

namespace mfar::eval {

/// Measures the requested methods on every sample of flowSamplesOf(). The columns are the run time,
/// the errors and the coverage of FlowError, and the areas of Sparsification. Throws EvalError,
/// RecordingError, TagMapError and ImageFileError.
[[nodiscard]] Report evaluateFlow(const SampleRequest& request);

}  // namespace mfar::eval
