#pragma once

#include "tests/shader/twins/luma.h"

#include <Eigen/Dense>

/// Scalar twin of patch.glsl.
namespace mfar::twin {

inline constexpr double kPatchNoise = 128;   // below this energy a patch counts as flat
inline constexpr double kPatchDamping = 64;  // on the diagonal of the Hessian

struct PatchMatch {
    double cost, gain, covariance, varianceA, varianceB;
    Eigen::Vector2d step;  ///< Gauss-Newton, at most a pixel long
};

/// The 8x8 patch around cell (cx, cy) of `a` against `b`, displaced by u.
inline PatchMatch comparePatch(const Grey& a, const Grey& b, int cx, int cy, Eigen::Vector2d u) {
    const int x0 = 4 * cx - 2, y0 = 4 * cy - 2;
    const double bx = std::clamp(x0 + u.x(), -7.0, b.size.width - 2.0);
    const double by = std::clamp(y0 + u.y(), -7.0, b.size.height - 2.0);
    Eigen::Matrix<double, 64, 1> va, vb;
    Eigen::Matrix<double, 64, 2> g;
    for (int i = 0; i < 64; ++i) {
        const int x = x0 + i % 8, y = y0 + i / 8;
        va[i] = a.at(x, y);
        const int column = i % 8, row = i / 8;
        vb[i] = b.bilinear(bx + column, by + row);
        g(i, 0) = 0.5 * (a.at(x + 1, y) - a.at(x - 1, y));
        g(i, 1) = 0.5 * (a.at(x, y + 1) - a.at(x, y - 1));
    }
    va.array() -= va.mean();
    vb.array() -= vb.mean();
    g.rowwise() -= g.colwise().mean().eval();
    PatchMatch m{};
    m.varianceA = va.squaredNorm();
    m.varianceB = vb.squaredNorm();
    m.covariance = va.dot(vb);
    m.gain = std::sqrt((m.varianceA + kPatchNoise) / (m.varianceB + kPatchNoise));
    const double energy = m.varianceA + m.gain * m.gain * m.varianceB;
    m.cost = std::max(energy - 2 * m.gain * m.covariance, 0.0) / (energy + kPatchNoise);
    const Eigen::Matrix2d hessian = g.transpose() * g + kPatchDamping * Eigen::Matrix2d::Identity();
    m.step = hessian.inverse() * (g.transpose() * (va - m.gain * vb));
    if (m.step.norm() > 1) m.step.normalize();
    return m;
}

}  // namespace mfar::twin
