#pragma once

#include "base/srgb.h"

#include <Eigen/Core>

namespace mfar {

/// Conversion of radiance to display values.
struct Exposure {
    float scale = 1;  ///< 1 / (radiance that is displayed as white); finite, above 0
    bool operator==(const Exposure&) const = default;
};

[[nodiscard]] Eigen::Vector3f displayed(const Eigen::Vector3f& radiance, const Exposure& exposure);

}  // namespace mfar
