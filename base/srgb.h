#pragma once

#include <array>

namespace mfar {

/// Converts a linear value to sRGB's encoding (IEC 61966-2-1). The value is clamped to [0, 1]; NaN
/// gives 0.
[[nodiscard]] float srgbEncoded(float linear);
/// Returns the derivative of srgbEncoded(). Outside [0, 1], it is the derivative at the nearer end.
[[nodiscard]] float srgbSlope(float linear);
[[nodiscard]] float srgbDecoded(float encoded);

/// Returns the linear value, in [0, 1], of each sRGB byte.
[[nodiscard]] const std::array<float, 256>& linearOfSrgbByte();

}  // namespace mfar
