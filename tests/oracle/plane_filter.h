#pragma once

#include "pipeline/engine/params/flow.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <vector>

namespace mfar::twin {

/// Grid of cells with flow (x, y), cost and texture. Positions outside it repeat the border cells.
struct FlowCells {
    const std::vector<std::array<float, 4>>& values;
    int width, height;

    [[nodiscard]] Eigen::Vector4d at(int x, int y) const {
        const auto& v = values[std::clamp(y, 0, height - 1) * width + std::clamp(x, 0, width - 1)];
        return {v[0], v[1], v[2], v[3]};
    }
};

inline Eigen::Vector2d medianAround(const FlowCells& cells, int x, int y) {
    Eigen::Vector2d out;
    for (int component = 0; component < 2; ++component) {
        std::array<double, 9> v{};
        for (int k = 0; k < 9; ++k)
            v[k] = cells.at(x + k % 3 - 1, y + k / 3 - 1)[component];
        std::nth_element(v.begin(), v.begin() + 4, v.end());
        out[component] = v[4];
    }
    return out;
}

/// Plane through the flow. Columns: flow at the cell, its change per column of cells, its change
/// per row of cells.
using Plane = Eigen::Matrix<double, 2, 3>;

/// `about`: an earlier estimate. Flow that differs from it by `reach` [px] or more has no weight.
inline Plane fitPlane(const FlowCells& cells, int x, int y, const Plane& about, double reach) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Plane right = Plane::Zero();
    for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) {
            const Eigen::Vector4d n = cells.at(x + i, y + j);
            const Eigen::Vector3d a(1, i, j);
            const Eigen::Vector2d d = n.head<2>() - about * a;
            const double near = std::max(1 - d.squaredNorm() / (reach * reach), 0.0);
            const double known = n[3] / (n[3] + params::kHalfTrusted) * std::max(1 - 2 * n[2], 0.0);
            const double w = near * (near * known + params::kLeastPlaneWeight);
            normal += w * a * a.transpose();
            right += w * d * a.transpose();
        }
    const double damp = params::kSlopeDamping + params::kSlopeDampingPerWeight * normal(0, 0);
    normal.diagonal() += Eigen::Vector3d(1e-6, damp, damp);
    return about + right * normal.inverse();
}

inline Eigen::Vector2d filterCell(const FlowCells& cells, int x, int y, int planeFits) {
    Plane plane = Plane::Zero();
    plane.col(0) = medianAround(cells, x, y);
    for (int i = 0; i < planeFits; ++i)
        plane =
            fitPlane(cells, x, y, plane, i == 0 ? params::kFirstPlaneReach : params::kPlaneReach);
    return plane.col(0);
}

}  // namespace mfar::twin
