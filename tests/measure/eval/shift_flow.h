#pragma once

#include "tests/measure/eval/flow_methods.h"

namespace mfar::eval {

/// The simplest flow, which every other method should beat: one shift of the whole picture, found
/// by phase correlation.
[[nodiscard]] std::unique_ptr<FlowMethod> shiftFlow(const StereoRig& rig);

}  // namespace mfar::eval
