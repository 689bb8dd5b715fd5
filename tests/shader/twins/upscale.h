#pragma once

#include "pipeline/engine/params/detail.h"
#include "pipeline/engine/params/still.h"
#include "tests/shader/twins/luma.h"

#include <array>

/// Scalar twins of the passes that draw: one channel, grey levels.
namespace mfar::twin {

/// Keys' cubic with a = -0.75: weights of the four samples around a fraction t.
inline std::array<double, 4> cubic(double t) {
    const auto w = [](double d) {
        const double a = params::kCubicSlope;
        d = std::abs(d);
        return d <= 1 ? (a + 2) * d * d * d - (a + 3) * d * d + 1
                      : a * d * d * d - 5 * a * d * d + 8 * a * d - 4 * a;
    };
    return {w(1 + t), w(t), w(1 - t), w(2 - t)};
}

inline double rounded(double v) {
    return std::floor(std::clamp(v, 0.0, 255.0) + 0.5);
}

/// Of Keys' cubic or, with the outer two zero, linear.
inline std::array<double, 4> enlargingWeights(double t, bool linear) {
    if (linear) return {0, 1 - t, t, 0};
    return cubic(t);
}

/// Columns first, kept in 8 bits, then rows.
inline Grey upscaledColumns(const Grey& g, int height, bool linear = false) {
    return greyOf({g.size.width, height}, [&](int x, int y) {
        const double p = (y + 0.5) * g.size.height / height - 0.5;
        const int i = static_cast<int>(std::floor(p));
        double sum = 0;
        for (int k = 0; k < 4; ++k)
            sum += enlargingWeights(p - i, linear)[k] * g.at(x, i + k - 1);
        return rounded(sum);
    });
}
inline Grey upscaled(const Grey& g, Size to, bool linear = false) {
    const Grey columns = upscaledColumns(g, to.height, linear);
    return greyOf(to, [&](int x, int y) {
        const double p = (x + 0.5) * g.size.width / to.width - 0.5;
        const int i = static_cast<int>(std::floor(p));
        double sum = 0;
        for (int k = 0; k < 4; ++k)
            sum += enlargingWeights(p - i, linear)[k] * columns.at(i + k - 1, y);
        return sum;
    });
}

inline constexpr double kNearTap = params::kSharpenNear, kFarTap = params::kSharpenFar;

/// The prefilter along both axes, with the product of the nearest taps across.
inline Grey sharpened(const Grey& g, double strength) {
    return greyOf(g.size, [&](int x, int y) {
        const double c = g.at(x, y);
        double high = 0;
        for (int s : {-1, 1}) {
            high += kNearTap * (g.at(x + s, y) + g.at(x, y + s) - 2 * c);
            high += kFarTap * (g.at(x + 2 * s, y) + g.at(x, y + 2 * s) - 2 * c);
            for (int t : {-1, 1})  // (f(x + s) - f(x)) along x, then along y
                high += kNearTap * kNearTap *
                        (g.at(x + s, y + t) - g.at(x + s, y) - g.at(x, y + t) + c);
        }
        return c + strength * high;
    });
}

/// The still's luma on a coarser grid: mean of 4x4 bilinear taps over the footprint.
inline Grey stillLow(const Grey& still, Size low) {
    return greyOf(low, [&](int x, int y) {
        double sum = 0;
        for (int i = 0; i < 16; ++i) {
            const double u = (x + 0.5 + double{params::kFootprint} * (i % 4 - 1.5) / 4) / low.width;
            const int row = i / 4;
            const double v = (y + 0.5 + double{params::kFootprint} * (row - 1.5) / 4) / low.height;
            sum += still.bilinear(u * still.size.width - 0.5, v * still.size.height - 0.5) / 16;
        }
        return sum;
    });
}

}  // namespace mfar::twin
