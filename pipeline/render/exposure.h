#pragma once

#include <Eigen/Core>

namespace mfar {

/// From radiance to what a display is given.
struct Exposure {
    float scale = 1;  ///< radiance that becomes white is its inverse; finite, above 0
    bool operator==(const Exposure&) const = default;
};

/// Linear value to sRGB's encoding (IEC 61966-2-1), both cut to [0, 1]; NaN gives 0.
[[nodiscard]] float srgbEncoded(float linear);
/// The derivative of srgbEncoded() inside (0, 1), that at the end beyond.
[[nodiscard]] float srgbSlope(float linear);
/// The inverse of srgbEncoded() on [0, 1].
[[nodiscard]] float srgbDecoded(float encoded);

/// Radiance to display values in [0, 1], sRGB encoded.
[[nodiscard]] Eigen::Vector3f displayed(const Eigen::Vector3f& radiance, const Exposure& exposure);

}  // namespace mfar
