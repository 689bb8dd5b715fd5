#pragma once

namespace mfar {

/// A ray (x, y, 1) that is rotated into another camera's coordinates must have a z of at least
/// this. With a smaller z, it is almost parallel to that camera's image plane, and its projection
/// is unreliable.
inline constexpr double kNearPlane = 0.05;

}  // namespace mfar
