#pragma once

#include "pipeline/engine/params/detail.h"
#include "pipeline/engine/params/still.h"
#include "tests/oracle/luma.h"

#include <array>

/// Oracle of enlarging the video, in double precision. One channel in grey levels, neither rounded
/// nor clamped.
namespace mfar::twin {

/// Keys' cubic with a = -0.75: weights of the four samples around a position with fractional part
/// t.
inline std::array<double, 4> cubic(double t) {
    const auto w = [](double d) {
        const double a = params::kCubicSlope;
        d = std::abs(d);
        return d <= 1 ? (a + 2) * d * d * d - (a + 3) * d * d + 1
                      : a * d * d * d - 5 * a * d * d + 8 * a * d - 4 * a;
    };
    return {w(1 + t), w(t), w(1 - t), w(2 - t)};
}

inline std::array<double, 4> enlargingWeights(double t, bool linear) {
    if (linear) return {0, 1 - t, t, 0};
    return cubic(t);
}

/// Upper limit of the sum of a cubic's absolute weights. Along one axis, errors of the samples grow
/// at most by this factor.
inline constexpr double kCubicGain = 1.375;

inline Grey enlargedColumns(const Grey& g, int height, bool linear = false) {
    return greyOf({g.size.width, height}, [&](int x, int y) {
        const double p = centre(y, g.size.height, height);
        const int i = static_cast<int>(std::floor(p));
        double sum = 0;
        for (int k = 0; k < 4; ++k)
            sum += enlargingWeights(p - i, linear)[k] * g.at(x, i + k - 1);
        return sum;
    });
}
inline Grey enlargedRows(const Grey& g, int width, bool linear = false) {
    return greyOf({width, g.size.height}, [&](int x, int y) {
        const double p = centre(x, g.size.width, width);
        const int i = static_cast<int>(std::floor(p));
        double sum = 0;
        for (int k = 0; k < 4; ++k)
            sum += enlargingWeights(p - i, linear)[k] * g.at(i + k - 1, y);
        return sum;
    });
}
inline Grey enlarged(const Grey& g, Size to, bool linear = false) {
    return enlargedRows(enlargedColumns(g, to.height, linear), to.width, linear);
}

inline constexpr double kNearTap = params::kSharpenNear, kFarTap = params::kSharpenFar;

/// Sharpens along both axes. `strengthAt(x, y)`: strength at a pixel. A diagonal neighbour has the
/// square of the weight of a direct neighbour.
template <class F>
Grey sharpened(const Grey& g, F strengthAt) {
    return greyOf(g.size, [&](int x, int y) {
        const double c = g.at(x, y);
        double high = 0;
        for (int s : {-1, 1}) {
            high += kNearTap * (g.at(x + s, y) + g.at(x, y + s) - 2 * c);
            high += kFarTap * (g.at(x + 2 * s, y) + g.at(x, y + 2 * s) - 2 * c);
            for (int t : {-1, 1})
                high += kNearTap * kNearTap *
                        (g.at(x + s, y + t) - g.at(x + s, y) - g.at(x, y + t) + c);
        }
        return c + strengthAt(x, y) * high;
    });
}

}  // namespace mfar::twin
