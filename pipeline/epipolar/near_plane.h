#pragma once

namespace mfar {

/// A ray (x, y, 1) that is rotated into another camera's coordinates must have a z above this. With
/// a smaller z, it points backwards or is almost parallel to that camera's image plane, and its
/// projection is unreliable.
inline constexpr double kNearPlane = 0.05;

}  // namespace mfar
