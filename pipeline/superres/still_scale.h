#pragma once

#include "base/geometry.h"

namespace mfar {

/// Width of what a video pixel sees, in its pitch: the optics make it a quarter wider (+0.07 dB on
/// photographs, +0.4 dB on synthetic scenes against the bare pitch).
inline constexpr float kFootprint = 1.25F;

/// Neighbours' share that makes up for what a linear filter takes from the finest detail of a still
/// that was not reduced; see still_detail.frag.
inline constexpr float kLinearLoss = 0.08F;

/// The rig with a still camera that has no more pixels than an output of this size has a use for:
/// the same lens, maybe fewer pixels.
[[nodiscard]] StereoRig stillFor(Size output, StereoRig rig);

/// The still's pixel grid at the scale of the video: as many pixels as the video would need for it.
[[nodiscard]] Size lowSizeOf(const StereoRig& rig);

}  // namespace mfar
