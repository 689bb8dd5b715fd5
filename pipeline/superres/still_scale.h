#pragma once

#include "base/geometry.h"
#include "pipeline/engine/params/still.h"

namespace mfar {

using params::kFootprint;
using params::kLinearLoss;

/// The rig with a still camera that has no more pixels than an output of this size has a use for:
/// the same lens, maybe fewer pixels.
[[nodiscard]] StereoRig stillFor(Size output, StereoRig rig);

/// The still's pixel grid at the scale of the video: as many pixels as the video would need for it.
[[nodiscard]] Size lowSizeOf(const StereoRig& rig);

}  // namespace mfar
