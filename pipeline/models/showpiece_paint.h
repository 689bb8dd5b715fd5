#pragma once

#include "pipeline/models/lathe.h"
#include "pipeline/models/surface_paint.h"

namespace mfar {

/// Blue glaze on the jar's body. It is gilded where `height` [m], the height of the profile at v,
/// is in the shoulder's band.
[[nodiscard]] PaintedPoint glazeAt(float u, float height);

/// Walnut at a point of a log along x [m].
[[nodiscard]] PaintedPoint walnutAt(const Eigen::Vector3f& place);

/// Depth of the twisted flutes at an angle [rad] and a height [m]: 0 outside the flutes, 1 in a
/// groove.
[[nodiscard]] float fluteAt(float angle, float height);

}  // namespace mfar
