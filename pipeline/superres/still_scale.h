#pragma once

#include "base/geometry.h"
#include "pipeline/engine/params/still.h"

namespace mfar {

using params::kLinearLoss;

/// The rig with a still camera that has no more pixels than an output of this size has a use for:
/// the same lens, maybe fewer pixels.
[[nodiscard]] StereoRig stillFor(Size output, StereoRig rig);

}  // namespace mfar
