#pragma once

namespace mfar {

/// A ray of depth 1 is rotated into the coordinates of another camera. If its depth there is less
/// than this value, the ray is so close to that camera's image plane that its projection is
/// unreliable.
inline constexpr double kNearPlane = 0.05;

}  // namespace mfar
