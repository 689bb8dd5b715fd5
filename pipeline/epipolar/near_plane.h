#pragma once

namespace mfar {

/// A ray of length-one depth that is turned into another camera's frame must be left with this much
/// of it [share]; nearer to that camera's image plane its projection is not to be trusted.
inline constexpr double kNearPlane = 0.05;

}  // namespace mfar
