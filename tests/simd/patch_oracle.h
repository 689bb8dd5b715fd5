#pragma once

#include "pipeline/engine/params/patch.h"
#include "tests/simd/flow_pictures.h"

#include <Eigen/Dense>

/// Comparison of 8x8 patches in double precision, as short as possible.
namespace mfar::simd::oracle {

inline double pixelAt(const FlowPicture& p, int x, int y) {
    x = std::clamp(x, 0, p.size.width - 1);
    y = std::clamp(y, 0, p.size.height - 1);
    return p.pixels[static_cast<std::size_t>(y) * p.size.width + x];
}

/// Between (or a little beyond) the four pixels from (left, top) on.
inline double between(const FlowPicture& p, int left, int top, double fx, double fy) {
    return std::lerp(std::lerp(pixelAt(p, left, top), pixelAt(p, left + 1, top), fx),
                     std::lerp(pixelAt(p, left, top + 1), pixelAt(p, left + 1, top + 1), fx), fy);
}

using Patch = Eigen::Matrix<double, 64, 1>;

struct Match {
    double cost, texture;
    Eigen::Vector2d step;  ///< Gauss-Newton, at most a pixel long
};

/// The patch of cell (cx, cy) of `a` against pixels `vb`.
inline Match match(const FlowPicture& a, int cx, int cy, Patch vb) {
    Patch va;
    Eigen::Matrix<double, 64, 2> g;
    for (int i = 0; i < 64; ++i) {
        const int x = 4 * cx - 2 + i % 8, y = 4 * cy - 2 + i / 8;
        va[i] = pixelAt(a, x, y);
        g(i, 0) = (pixelAt(a, x + 1, y) - pixelAt(a, x - 1, y)) / 2;
        g(i, 1) = (pixelAt(a, x, y + 1) - pixelAt(a, x, y - 1)) / 2;
    }
    va.array() -= va.mean();
    vb.array() -= vb.mean();
    g.rowwise() -= g.colwise().mean().eval();
    const double gain = std::sqrt((va.squaredNorm() + params::kPatchNoise) /
                                  (vb.squaredNorm() + params::kPatchNoise));
    const double energy = va.squaredNorm() + gain * gain * vb.squaredNorm();
    const Eigen::Matrix2d hessian =
        g.transpose() * g + double{params::kPatchDamping} * Eigen::Matrix2d::Identity();
    Eigen::Vector2d step = hessian.inverse() * (g.transpose() * (va - gain * vb));
    if (step.norm() > 1) step.normalize();
    const double cost =
        std::max(energy - 2 * gain * va.dot(vb), 0.0) / (energy + params::kPatchNoise);
    return {cost, va.squaredNorm(), step};
}

/// ... of `b`, displaced by u.
inline Match compare(const FlowPicture& a, const FlowPicture& b, int cx, int cy,
                     const Eigen::Vector2d& u) {
    const double x = std::clamp(4 * cx - 2 + u.x(), -7.0, b.size.width - 2.0);
    const double y = std::clamp(4 * cy - 2 + u.y(), -7.0, b.size.height - 2.0);
    const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
    Patch vb;
    for (int i = 0; i < 64; ++i)
        vb[i] = between(b, left + i % 8, top + i / 8, x - left, y - top);
    return match(a, cx, cy, vb);
}

/// ... where the flow changes by dx, dy per pixel; `span` pixels of a row share the pixels between
/// which they lie.
inline Match compareBent(const FlowPicture& a, const FlowPicture& b, int cx, int cy,
                         const Eigen::Vector2d& u, const Eigen::Vector2d& dx,
                         const Eigen::Vector2d& dy, int span) {
    Patch vb;
    for (int i = 0; i < 64; ++i) {
        const int first = i % 8 / span * span, row = i / 8;
        const double middle = (span - 1) / 2.0;
        const Eigen::Vector2d place = Eigen::Vector2d(4 * cx - 2 + first, 4 * cy - 2 + row) + u +
                                      (first + middle - 3.5) * dx + (row - 3.5) * dy;
        const int left = static_cast<int>(std::floor(place.x()));
        const int top = static_cast<int>(std::floor(place.y()));
        const Eigen::Vector2d f = place - Eigen::Vector2d(left, top) + (i % span - middle) * dx;
        vb[i] = between(b, left + i % span, top, f.x(), f.y());
    }
    return match(a, cx, cy, vb);
}

}  // namespace mfar::simd::oracle
