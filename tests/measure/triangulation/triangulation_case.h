#pragma once

#include "tests/measure/triangulation/triangulation.h"
#include "tests/oracle/triangulation.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace mfar {

inline constexpr double kDegree = std::numbers::pi / 180;

inline RigidTransform moved(double degrees, const Eigen::Vector3d& axis,
                            const Eigen::Vector3d& translation) {
    return {Eigen::Quaterniond(Eigen::AngleAxisd(degrees * kDegree, axis.normalized())),
            translation};
}

inline twin::TwoViews bentViews(const RigidTransform& T_b_a) {
    return {{{640, 480}, 600, 602, 318, 241, {-0.12, 0.03, 0.001, -0.002, 0.01}},
            {{640, 480}, 580, 578, 322, 238, {0.08, -0.02, -0.001, 0.001, 0}},
            T_b_a};
}

/// Two lenses without distortion, whose focal length is 100 px.
inline twin::TwoViews plainViews(const RigidTransform& T_b_a) {
    const CameraModel camera{{64, 48}, 100, 100, 31.5, 23.5, {}};
    return {camera, camera, T_b_a};
}

template <class F>
std::vector<float> fieldOf(Size size, F vectorAt) {
    std::vector<float> out;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const Eigen::Vector2d v = vectorAt(Eigen::Vector2d(x, y));
            out.push_back(static_cast<float>(v.x()));
            out.push_back(static_cast<float>(v.y()));
        }
    return out;
}

inline Eigen::Vector2d vectorAt(const std::vector<float>& field, std::size_t i) {
    return {field[2 * i], field[2 * i + 1]};
}

inline std::vector<TriangulatedPoint> triangulated(const twin::TwoViews& views,
                                                   const std::vector<float>& flow,
                                                   const TriangulationOptions& options = {}) {
    Triangulation stage(views.a, views.b);
    return stage.run(flow, views.T_b_a, options);
}

}  // namespace mfar
