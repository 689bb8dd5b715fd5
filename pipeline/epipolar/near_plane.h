#pragma once

namespace mfar {

/// Lower limit of z of a ray (x, y, 1) after its rotation into another camera's coordinates. With a
/// smaller z, the ray is almost parallel to that camera's image plane, and its projection is
/// unreliable.
inline constexpr double kNearPlane = 0.05;

}  // namespace mfar
