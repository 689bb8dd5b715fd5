#pragma once

namespace mfar {

/// A ray of depth 1 is rotated into another camera's coordinates. With a smaller depth than this,
/// it is so close to that camera's image plane that its projection is unreliable.
inline constexpr double kNearPlane = 0.05;

}  // namespace mfar
