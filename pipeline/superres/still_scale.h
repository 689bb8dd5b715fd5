#pragma once

#include "base/geometry.h"
#include "pipeline/engine/params/still.h"

namespace mfar {

using params::kLinearLoss;

/// Returns the rig with its still camera reduced to the resolution that an output of this size can
/// use. Only the number of pixels becomes smaller; the lens stays the same.
[[nodiscard]] StereoRig stillFor(Size output, StereoRig rig);

}  // namespace mfar
