#pragma once

#include "base/geometry.h"
#include "pipeline/engine/params/still.h"

namespace mfar {

using params::kLinearLoss;

/// The rig with its still camera reduced to the resolution that an output of this size can use: the
/// same lens, perhaps fewer pixels.
[[nodiscard]] StereoRig stillFor(Size output, StereoRig rig);

}  // namespace mfar
