#pragma once

#include <Eigen/Core>

namespace mfar {

template <typename Number>
[[nodiscard]] Number luminanceOf(const Eigen::Vector3<Number>& rgb) {
    return rgb.dot(Eigen::Vector3d(0.2126, 0.7152, 0.0722).cast<Number>());
}

}  // namespace mfar
