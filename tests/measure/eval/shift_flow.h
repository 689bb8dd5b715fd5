#pragma once

#include "tests/measure/eval/flow_methods.h"

namespace mfar::eval {

/// One shift for the whole picture, by phase correlation: what a flow has to be better than.
[[nodiscard]] std::unique_ptr<FlowMethod> shiftFlow(const StereoRig& rig);

}  // namespace mfar::eval
