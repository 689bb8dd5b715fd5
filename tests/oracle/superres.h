#pragma once

#include "pipeline/engine/params/detail.h"
#include "pipeline/engine/params/weigh.h"
#include "tests/oracle/luma.h"

#include <Eigen/Dense>

#include <array>

namespace mfar::twin {

struct Cells {
    Size size;
    std::vector<float> values;

    [[nodiscard]] Eigen::Vector4d at(int x, int y) const {
        x = std::clamp(x, 0, size.width - 1);
        y = std::clamp(y, 0, size.height - 1);
        return Eigen::Vector4f(&values[4UL * (1UL * y * size.width + x)]).cast<double>();
    }
    [[nodiscard]] Eigen::Vector4d bilinear(double x, double y) const {
        const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
        const double fx = x - x0, fy = y - y0;
        return (1 - fy) * ((1 - fx) * at(x0, y0) + fx * at(x0 + 1, y0)) +
               fy * ((1 - fx) * at(x0, y0 + 1) + fx * at(x0 + 1, y0 + 1));
    }
};

/// Confidence by eq. 2 of the paper (see docs/paper.md), with lambda(x) = min(x, 1).
inline double confidence(const Eigen::Vector2d& forward, const Eigen::Vector2d& backward,
                         double alpha) {
    return 1 - std::min((forward + backward).norm() / alpha, 1.0);
}

struct Weight {
    double weight, confidence, signal, unexplained;
    double variance;  ///< of the video around the cell [grey levels^2]
};

/// Change of the flow around a cell [px per px].
inline double bendAt(const Cells& flow, int x, int y) {
    const Eigen::Vector4d dx = flow.at(x + 1, y) - flow.at(x - 1, y);
    const Eigen::Vector4d dy = flow.at(x, y + 1) - flow.at(x, y - 1);
    return std::sqrt(dx.head<2>().squaredNorm() + dy.head<2>().squaredNorm()) / 8;
}

/// Second difference of the flow at a cell [px].
inline double tearAt(const Cells& flow, int x, int y) {
    const Eigen::Vector4d here = 2 * flow.at(x, y);
    const Eigen::Vector4d dx = flow.at(x + 1, y) + flow.at(x - 1, y) - here;
    const Eigen::Vector4d dy = flow.at(x, y + 1) + flow.at(x, y - 1) - here;
    return std::sqrt(dx.head<2>().squaredNorm() + dy.head<2>().squaredNorm());
}

/// True if the flow jumps from a cell to the next one, (dx, dy) further; see params::kJump.
inline bool jumps(const Cells& flow, int x, int y, int dx, int dy) {
    const auto change = [&](int k) {
        return (flow.at(x + (k + 1) * dx, y + (k + 1) * dy) - flow.at(x + k * dx, y + k * dy))
            .head<2>()
            .norm();
    };
    return change(0) > params::kJump + params::kJumpPerChange * std::max(change(-1), change(1));
}

/// LookUpCell::confidenceAndJumps without the confidence.
inline double jumpsAt(const Cells& flow, int x, int y) {
    return (jumps(flow, x, y, 1, 0) ? params::kJumpRight : 0) +
           (jumps(flow, x, y, 0, 1) ? params::kJumpBelow : 0);
}

/// A member of LookUpCell at position (x, y) [cells]. Across jumps, the nearer cell counts alone.
/// `codes`: LookUpCell::confidenceAndJumps.
inline double lookedUp(const Grey& member, const Grey& codes, double x, double y) {
    const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
    const auto code = [&](int i, int j) { return static_cast<int>(codes.at(i, j)); };
    const auto share = [](double t, bool jumps) { return jumps ? std::round(t) : t; };
    const auto row = [&](int j) {
        const bool right = code(left, j) / 2 % 2 == 1;
        return std::lerp(member.at(left, j), member.at(left + 1, j), share(x - left, right));
    };
    const bool below = code(static_cast<int>(std::floor(x + 0.5)), top) / 4 == 1;
    return std::lerp(row(top), row(top + 1), share(y - top, below));
}

inline double smoothstep(double low, double high, double v) {
    const double t = std::clamp((v - low) / (high - low), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// Second difference of the flow [px] where it is bent, 0 elsewhere.
inline double kinkAt(const Cells& flow, int x, int y) {
    return smoothstep(params::kEvenFlow, params::kBentFlow, bendAt(flow, x, y)) *
           tearAt(flow, x, y);
}

/// Weight of a cell. Channels of `statistics`: covariance of video and still, variance of the
/// video, variance of the still, confidence. `half` holds the statistics at half the resolution.
/// `sigma`: standard deviation of the noise [grey levels].
inline Weight weigh(const Cells& flow, const Cells& statistics, const Cells& half, int x, int y,
                    double sigma) {
    Eigen::Vector4d s = Eigen::Vector4d::Zero(), h = Eigen::Vector4d::Zero();
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
            s += (2 - std::abs(i)) * (2 - std::abs(j)) / 16.0 * statistics.at(x + i, y + j);
    for (int j = 0; j <= 1; ++j)
        for (int i = 0; i <= 1; ++i)
            h += 0.25 * half.at(x / 2 + (x % 2 == 1 ? i : -i), y / 2 + (y % 2 == 1 ? j : -j));
    const double noise = params::kPatchPixels * (sigma * sigma + params::kByteVariance);
    const double halfNoise = params::kPatchPixels * (0.25 * sigma * sigma + params::kByteVariance);
    const double covariance = std::max(s[0], 0.0);
    const double gain = covariance / (s[2] + noise);
    const double halfGain = std::max(h[0], 0.0) / (h[2] + halfNoise);
    const double share = h[2] / (h[2] + params::kLowContrast * halfNoise);
    const double ncc2 = covariance * covariance / ((s[1] + noise) * (s[2] + noise));
    const double conf = statistics.at(x, y)[3];
    const double a =
        std::min(std::lerp(gain, std::max(gain, halfGain), share), double{params::kLargestGain});
    const double trust = std::lerp(
        params::kLookUpLoss * smoothstep(params::kUnlikePatches, params::kAlikePatches, ncc2),
        ncc2 * ncc2, smoothstep(params::kEvenFlow, params::kBentFlow, bendAt(flow, x, y)));
    const double torn = smoothstep(params::kSmoothStep, params::kTornStep, tearAt(flow, x, y));
    const double w = a * trust * conf * (1 - torn);
    const bool textured = s[1] >= params::kTexturedContrast * (noise + params::kPatchPixels);
    return {w > params::kSmallestWeight ? w : 0, conf,
            std::clamp((s[1] - 2 * noise) / (s[1] + noise), 0.0, 1.0),
            textured && ncc2 * conf <= params::kUnexplainedMatch ? 1.0 : 0.0,
            s[1] / params::kPatchPixels};
}

/// Class of a tile, decided by its cells and the ring of cells around them. 1: enlarged only; 2:
/// trusted (affine flow, uniform weight); 3: blended.
inline unsigned tileClass(const Cells& field, int tileX, int tileY) {
    const int x0 = 4 * tileX, y0 = 4 * tileY;
    const Eigen::Vector4d origin = field.at(x0, y0);
    const Eigen::Vector4d dx = (field.at(x0 + 3, y0) - origin) / 3;
    const Eigen::Vector4d dy = (field.at(x0, y0 + 3) - origin) / 3;
    double low = 1e9, high = -1e9, spread = 0;
    for (int y = -1; y <= 4; ++y)
        for (int x = -1; x <= 4; ++x) {
            const Eigen::Vector4d c = field.at(x0 + x, y0 + y);
            low = std::min(low, c[2]);
            high = std::max(high, c[2]);
            const Eigen::Vector4d off = c - origin - x * dx - y * dy;
            spread = std::max(spread, off.head<2>().cwiseAbs().maxCoeff());
        }
    if (high <= params::kLeastDetailWeight) return 1;
    return high - low < params::kPlainWeight && spread < params::kPlainFlow ? 2 : 3;
}

}  // namespace mfar::twin
