#pragma once

#include "base/geometry.h"
#include "pipeline/engine/params/still.h"

namespace mfar {

using params::kLinearLoss;

/// Returns the rig with its still camera reduced to the resolution that an output picture of this
/// size can use. The lens stays the same; the number of pixels may become smaller.
[[nodiscard]] StereoRig stillFor(Size output, StereoRig rig);

}  // namespace mfar
