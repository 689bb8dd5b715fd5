#pragma once

#include "base/srgb.h"

#include <Eigen/Core>

namespace mfar {

/// Conversion of radiance to display values.
struct Exposure {
    float scale = 1;  ///< 1 / (radiance that becomes white); finite, above 0
    bool operator==(const Exposure&) const = default;
};

/// Radiance to display values in [0, 1], sRGB encoded.
[[nodiscard]] Eigen::Vector3f displayed(const Eigen::Vector3f& radiance, const Exposure& exposure);

}  // namespace mfar
