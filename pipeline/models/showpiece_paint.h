#pragma once

#include "pipeline/models/lathe.h"
#include "pipeline/models/surface_paint.h"

namespace mfar {

/// Returns the look of the jar's body: blue glaze, which is gilded in the band at the shoulder.
/// `u`: texture coordinate around the axis; `height`: height of the point [m].
[[nodiscard]] PaintedPoint glazeAt(float u, float height);

/// Returns the look of walnut wood at a point [m] of a log whose axis is x.
[[nodiscard]] PaintedPoint walnutAt(const Eigen::Vector3f& place);

/// Returns the depth of the twisted flutes at an angle [rad] and a height [m]: 0 outside the
/// flutes, 1 in a groove.
[[nodiscard]] float fluteAt(float angle, float height);

}  // namespace mfar
