#pragma once

#include "base/geometry.h"
#include "base/lens_params.h"

namespace mfar {

/// Converts the lens to single precision for shaders and SIMD kernels.
[[nodiscard]] inline params::Lens lensOf(const CameraModel& camera) {
    const auto single = [](double v) { return static_cast<float>(v); };
    const auto& d = camera.distortion;
    return {single(camera.fx), single(camera.fy), single(camera.cx),
            single(camera.cy), single(d[0]),      single(d[1]),
            single(d[2]),      single(d[3]),      single(d[4])};
}

[[nodiscard]] inline std::array<params::Row3, 3> rowsOf(const Eigen::Quaterniond& rotation) {
    const Eigen::Matrix3f r = rotation.toRotationMatrix().cast<float>();
    return {
        {{r(0, 0), r(0, 1), r(0, 2)}, {r(1, 0), r(1, 1), r(1, 2)}, {r(2, 0), r(2, 1), r(2, 2)}}};
}

}  // namespace mfar
