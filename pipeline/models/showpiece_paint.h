#pragma once

#include "pipeline/models/lathe.h"
#include "pipeline/models/surface_paint.h"

namespace mfar {

/// Returns the look of the jar's body at texture coordinate `u` around the axis and `height` [m]:
/// blue glaze with a gilded band at the shoulder.
[[nodiscard]] PaintedPoint glazeAt(float u, float height);

/// Returns the look of walnut at `place`, a point [m] of a log whose axis is x.
[[nodiscard]] PaintedPoint walnutAt(const Eigen::Vector3f& place);

/// Returns the depth of the twisted flutes at an angle [rad] and a height [m]: 0 above and below
/// the flutes, about 0 on the ridges between them, and about 0.8 in the middle of a groove.
[[nodiscard]] float fluteAt(float angle, float height);

}  // namespace mfar
