#pragma once

#include <Eigen/Core>

namespace mfar {

/// Returns the nine real spherical harmonics up to degree 2 in a direction (unit vector), in the
/// order 1; y, z, x; xy, yz, 3z^2 - 1, xz, x^2 - y^2. They are orthonormal over the sphere. Source:
/// Ramamoorthi, Hanrahan, An Efficient Representation for Irradiance Environment Maps, SIGGRAPH
/// 2001, eq. 3.
[[nodiscard]] Eigen::Vector<float, 9> harmonicsAt(const Eigen::Vector3f& direction);

/// Radiance from all directions, as nine coefficients of spherical harmonics per colour channel.
using SphericalLight = Eigen::Matrix<float, 9, 3>;

[[nodiscard]] inline Eigen::Vector3f radianceOf(const SphericalLight& light,
                                                const Eigen::Vector3f& direction) {
    return light.transpose() * harmonicsAt(direction);
}

}  // namespace mfar
