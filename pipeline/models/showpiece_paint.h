#pragma once

#include "pipeline/models/lathe.h"
#include "pipeline/models/surface_paint.h"

namespace mfar {

/// Blue glaze on the jar's body, gilded where `height` [m], the profile's height at v, is inside
/// the shoulder's band.
[[nodiscard]] PaintedPoint glazeAt(float u, float height);

/// Walnut, cut from a log along x, at a point in the log [m].
[[nodiscard]] PaintedPoint walnutAt(const Eigen::Vector3f& place);

/// Depth of the twisted flutes at an angle [rad] and height [m]: 0 outside of flutes, 1 in a
/// groove.
[[nodiscard]] float fluteAt(float angle, float height);

}  // namespace mfar
