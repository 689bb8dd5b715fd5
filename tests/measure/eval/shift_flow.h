#pragma once

#include "tests/measure/eval/flow_methods.h"

namespace mfar::eval {

/// One shift for the whole picture, by phase correlation: a baseline that any flow method should
/// beat.
[[nodiscard]] std::unique_ptr<FlowMethod> shiftFlow(const StereoRig& rig);

}  // namespace mfar::eval
