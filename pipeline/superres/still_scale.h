#pragma once

#include "base/geometry.h"
#include "pipeline/engine/params/still.h"

namespace mfar {

using params::kLinearLoss;

/// Returns `rig` with its still camera reduced to the resolution that a picture of size `output`
/// can show. Only the number of pixels becomes smaller; the lens stays the same. Returns `rig`
/// unchanged if the width or the height would shrink by a tenth or less.
[[nodiscard]] StereoRig stillFor(Size output, StereoRig rig);

/// Returns the variance that is removed from the luma of a still as noise [grey levels^2]; 0:
/// nothing is removed. `noise`: standard deviation of the noise in the whole still [grey levels].
/// The luma has the size `shown`, which is the size `whole` or smaller, see stillFor().
[[nodiscard]] float quietVariance(double noise, Size whole, Size shown);

}  // namespace mfar
