#pragma once

#include <Eigen/Core>

namespace mfar {

struct LightSample {
    Eigen::Vector3f direction{0, 0, 1};  ///< world frame, unit length
    Eigen::Vector3f radiance{0, 0, 0};
    float density = 0;  ///< probability density of `direction` [1/sr]; 0 if no light was found
};

/// Returns a rotation whose third column is `normal` (Duff et al. 2017). `normal` must have unit
/// length.
[[nodiscard]] inline Eigen::Matrix3f frameAround(const Eigen::Vector3f& normal) {
    const float sign = normal.z() < 0 ? -1.0F : 1.0F;
    const float a = -1 / (sign + normal.z()), b = normal.x() * normal.y() * a;
    Eigen::Matrix3f out;
    out.col(0) =
        Eigen::Vector3f(1 + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x());
    out.col(1) = Eigen::Vector3f(b, sign + normal.y() * normal.y() * a, -normal.y());
    out.col(2) = normal;
    return out;
}

}  // namespace mfar
