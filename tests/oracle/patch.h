#pragma once

#include "pipeline/engine/params/patch.h"
#include "tests/oracle/luma.h"

#include <Eigen/Dense>

/// Oracle, in double precision, of the comparison of 8x8 patches in patch.glsl and in the SIMD
/// kernels.
namespace mfar::twin {

struct PatchMatch {
    double cost, gain, covariance, varianceA, varianceB;
    Eigen::Vector2d step;  ///< Gauss-Newton step, at most one pixel long
};

using Patch = Eigen::Matrix<double, 64, 1>;

/// First column (or row) of the patch of a cell, in a picture with `pixels` columns (or rows).
inline int patchStart(int cell, int pixels) {
    return std::max(std::min(4 * cell - 2, pixels - 8), 0);
}

/// Compares the 8x8 patch of `a` around cell (cx, cy) with 8x8 pixels `vb` of another picture.
inline PatchMatch matchPatch(const Grey& a, int cx, int cy, Patch vb) {
    const int x0 = patchStart(cx, a.size.width), y0 = patchStart(cy, a.size.height);
    Patch va;
    Eigen::Matrix<double, 64, 2> g;
    for (int i = 0; i < 64; ++i) {
        const int x = x0 + i % 8, y = y0 + i / 8;
        va[i] = a.at(x, y);
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
    m.gain = std::sqrt((m.varianceA + params::kPatchNoise) / (m.varianceB + params::kPatchNoise));
    const double energy = m.varianceA + m.gain * m.gain * m.varianceB;
    m.cost = std::max(energy - 2 * m.gain * m.covariance, 0.0) / (energy + params::kPatchNoise);
    const Eigen::Matrix2d hessian =
        g.transpose() * g + params::kPatchDamping * Eigen::Matrix2d::Identity();
    m.step = hessian.inverse() * (g.transpose() * (va - m.gain * vb));
    if (m.step.norm() > 1) m.step.normalize();
    return m;
}

/// Compares the patch of `a` around cell (cx, cy) with the patch of `b` that is displaced by `u`.
inline PatchMatch comparePatch(const Grey& a, const Grey& b, int cx, int cy, Eigen::Vector2d u) {
    const double bx = std::clamp(patchStart(cx, b.size.width) + u.x(), -7.0, b.size.width - 2.0);
    const double by = std::clamp(patchStart(cy, b.size.height) + u.y(), -7.0, b.size.height - 2.0);
    Patch vb;
    for (int i = 0; i < 64; ++i) {
        const int column = i % 8, row = i / 8;
        vb[i] = b.bilinear(bx + column, by + row);
    }
    return matchPatch(a, cx, cy, vb);
}

/// Like comparePatch(), but the flow changes by `dx` per pixel along x and by `dy` along y. As in
/// the tested code, the whole-pixel position in `b` is computed once for each group of `span`
/// pixels in a row; within a group, `dx` only changes the interpolation weights.
inline PatchMatch compareBentPatch(const Grey& a, const Grey& b, int cx, int cy,
                                   const Eigen::Vector2d& u, const Eigen::Vector2d& dx,
                                   const Eigen::Vector2d& dy, int span = 4) {
    const double middle = (span - 1) / 2.0;
    const int x0 = patchStart(cx, b.size.width), y0 = patchStart(cy, b.size.height);
    // Position of the patch relative to the middle of the cell.
    const double left0 = x0 - (4 * cx + 1.5), top0 = y0 - (4 * cy + 1.5);
    Patch vb;
    for (int i = 0; i < 64; ++i) {
        const int first = i % 8 / span * span, column = i % span, row = i / 8;
        const Eigen::Vector2d block = Eigen::Vector2d(x0 + first, y0 + row) + u +
                                      (left0 + first + middle) * dx + (top0 + row) * dy;
        const double x = std::clamp(block.x(), -7.0, b.size.width + 2.0);
        const double y = std::clamp(block.y(), -7.0, b.size.height + 2.0);
        const int left = static_cast<int>(std::floor(x)) + column;
        const int top = static_cast<int>(std::floor(y));
        const Eigen::Vector2d f =
            Eigen::Vector2d(x - std::floor(x), y - std::floor(y)) + (column - middle) * dx;
        vb[i] = (1 - f.y()) * ((1 - f.x()) * b.at(left, top) + f.x() * b.at(left + 1, top)) +
                f.y() * ((1 - f.x()) * b.at(left, top + 1) + f.x() * b.at(left + 1, top + 1));
    }
    return matchPatch(a, cx, cy, vb);
}

}  // namespace mfar::twin
