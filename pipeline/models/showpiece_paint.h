#pragma once

#include "pipeline/models/lathe.h"
#include "pipeline/models/surface_paint.h"

namespace mfar {

/// Blue glaze over the jar's body, gilded where `height` [m] is in the shoulder's band.
/// `height`: of the body's profile at v.
[[nodiscard]] PaintedPoint glazeAt(float u, float height);

/// Walnut, cut out of a log that lies along x: a place in it [m].
[[nodiscard]] PaintedPoint walnutAt(const Eigen::Vector3f& place);

/// How deep the twisted flutes are at an angle [rad] and height [m]: 0 outside them, 1 in a groove.
[[nodiscard]] float fluteAt(float angle, float height);

}  // namespace mfar
