#pragma once

namespace mfar {

/// Lower limit of the depth that a ray of depth one keeps when it is rotated into another camera's
/// frame [share]. Nearer to that camera's image plane its projection is unreliable.
inline constexpr double kNearPlane = 0.05;

}  // namespace mfar
