#pragma once

namespace mfar {

/// A ray of depth 1 is rotated into another camera's coordinates. If its depth is then smaller than
/// this limit, the ray is so close to that camera's image plane that its projection is unreliable.
inline constexpr double kNearPlane = 0.05;

}  // namespace mfar
