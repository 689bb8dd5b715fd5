#pragma once

#include "base/geometry.h"

namespace mfar {

// What both engines make of a still for adding its detail.

/// Width of what a video pixel sees, in its pitch; see still_low.frag.
inline constexpr double kStillFootprint = 1.25;
/// Neighbours' share that makes up for the bilinear look-up, on stills that were not reduced; see
/// still_detail.frag.
inline constexpr double kStillNeighbours = 0.08;

/// The rig whose still has no more pixels than an output of this size has a use for.
[[nodiscard]] StereoRig withStillReduced(const StereoRig& rig, Size output);
/// The still's pixel grid at the scale of the video: as many pixels as the video would need for it.
[[nodiscard]] Size stillSizeAtVideoScale(const StereoRig& rig);

}  // namespace mfar
