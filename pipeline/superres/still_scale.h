#pragma once

#include "base/geometry.h"
#include "pipeline/engine/params/still.h"

namespace mfar {

using params::kLinearLoss;

/// Returns `rig` with its still camera reduced to the resolution that a picture of size `output`
/// can show. Only the number of pixels becomes smaller; the lens stays the same.
[[nodiscard]] StereoRig stillFor(Size output, StereoRig rig);

}  // namespace mfar
