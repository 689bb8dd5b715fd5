#pragma once

#include <array>

namespace mfar {

/// Linear value to sRGB's encoding (IEC 61966-2-1), both cut to [0, 1]; NaN gives 0.
[[nodiscard]] float srgbEncoded(float linear);
/// The derivative of srgbEncoded() inside (0, 1), that at the end beyond.
[[nodiscard]] float srgbSlope(float linear);
/// The inverse of srgbEncoded() on [0, 1].
[[nodiscard]] float srgbDecoded(float encoded);

/// What an sRGB byte stands for, [0, 1] linear.
[[nodiscard]] const std::array<float, 256>& linearOfSrgbByte();

}  // namespace mfar
