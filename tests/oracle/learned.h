#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "tests/oracle/enlarge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

/// Oracle of the learned enlarger in double precision. Pictures are luma in grey levels. The
/// residual is what learned filters add to Keys' cubic.
namespace mfar::twin {

struct Classified {
    int number;     ///< of the class
    double margin;  ///< Thresholds::margin()
};

/// Finds the bins of several values. margin() is the smallest distance of a value from a border
/// between bins; if it is tiny, rounding may decide.
class Thresholds {
public:
    template <class Range>
    int count(double value, const Range& from) {
        int out = 0;
        for (const double t : from) {
            margin_ = std::min(margin_, std::abs(value - t));
            out += value >= t;
        }
        return out;
    }
    /// Returns the index of the bin that contains half the angle atan2(sine, cosine). There are
    /// `bins` equal bins from -pi/2 to pi/2.
    int bin(double cosine, double sine, int bins) {
        const double at = (std::atan2(sine, cosine) / (2 * std::numbers::pi) + 0.5) * bins;
        margin_ = std::min(margin_, std::abs(at - std::round(at)));
        return static_cast<int>(std::floor(at)) % bins;
    }
    [[nodiscard]] double margin() const { return margin_; }

private:
    double margin_ = 1e9;
};

inline Classified gradientClass(const Grey& g, int x, int y) {
    using C = enlarge::GradientClasses;
    double xx = 0, xy = 0, yy = 0;
    for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) {
            const double gx = (g.at(x + i + 1, y + j) - g.at(x + i - 1, y + j)) / 2,
                         gy = (g.at(x + i, y + j + 1) - g.at(x + i, y + j - 1)) / 2;
            xx += gx * gx / 25;
            xy += gx * gy / 25;
            yy += gy * gy / 25;
        }
    const double d = std::hypot(xx - yy, 2 * xy);
    const double s1 = std::sqrt((xx + yy + d) / 2), s2 = std::sqrt(std::max(xx + yy - d, 0.0) / 2);
    Thresholds t;
    const int bin = t.bin(xx - yy, 2 * xy, C::kAngles), strength = t.count(s1, C::kStrengthFrom),
              coherence = t.count((s1 - s2) / (s1 + s2 + 1e-12), C::kCoherenceFrom);
    return {(bin * 4 + strength) * 3 + coherence, t.margin()};
}

inline Classified curvatureClass(const Grey& g, int x, int y) {
    using C = enlarge::CurvatureClasses;
    const double xx = g.at(x + 1, y) - 2 * g.at(x, y) + g.at(x - 1, y),
                 yy = g.at(x, y + 1) - 2 * g.at(x, y) + g.at(x, y - 1),
                 xy = (g.at(x + 1, y + 1) - g.at(x + 1, y - 1) - g.at(x - 1, y + 1) +
                       g.at(x - 1, y - 1)) /
                      4;
    Thresholds t;
    const int bin = t.bin(xx - yy, 2 * xy, C::kAngles),
              laplacian = t.count(xx + yy, C::kLaplacianFrom),
              difference = t.count(std::hypot(xx - yy, 2 * xy), C::kDifferenceFrom);
    return {(bin * 7 + laplacian) * 4 + difference, t.margin()};
}

inline std::array<double, 2> rangeAround(const Grey& g, int x, int y) {
    std::array<double, 2> out{1e9, -1e9};
    for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i)
            out = {std::min(out[0], g.at(x + i, y + j)), std::max(out[1], g.at(x + i, y + j))};
    return out;
}

inline double residualAt(const Grey& g, int x, int y, int phase, int gradient, int curvature,
                         const FilterBank& bank) {
    const auto scale = double(enlarge::kWeightScale);
    double sum = 0, up = 0;
    for (int i = 0; i < enlarge::kTaps; ++i) {
        const auto at = enlarge::kTapAt[i];
        const double step = g.at(x + at.x, y + at.y) - g.at(x, y);
        const int n = enlarge::filterIndex(i, phase);
        sum += step * (bank.gradient()[gradient][n] + bank.curvature()[curvature][n]) / scale;
        up += step * bank.cubic()[n] / scale;
    }
    const auto [low, high] = rangeAround(g, x, y);
    const double more = (high - low) / (1 << enlarge::kOvershootShift), here = g.at(x, y);
    return std::clamp(sum + up, low - more - here, high + more - here) - up;
}

inline Grey residualGrid(const Grey& g, const FilterBank& bank) {
    constexpr int kGrid = enlarge::kGrid;
    Grey out{{kGrid * g.size.width, kGrid * g.size.height}, {}};
    out.values.resize(std::size_t(out.size.width) * out.size.height);
    for (int y = 0; y < g.size.height; ++y)
        for (int x = 0; x < g.size.width; ++x) {
            const int gradient = gradientClass(g, x, y).number,
                      curvature = curvatureClass(g, x, y).number;
            for (int p = 0; p < enlarge::kPhases; ++p)
                out.values[std::size_t(kGrid * y + p / kGrid) * out.size.width + kGrid * x +
                           p % kGrid] = residualAt(g, x, y, p, gradient, curvature, bank);
        }
    return out;
}

inline Grey learnedResidual(const Grey& g, Size to, const FilterBank& bank) {
    return enlarged(residualGrid(g, bank), to, true);
}

}  // namespace mfar::twin
