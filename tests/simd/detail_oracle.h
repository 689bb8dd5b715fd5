#pragma once

#include "base/image_view.h"
#include "base/rows.h"
#include "pipeline/engine/params/detail.h"
#include "pipeline/engine/params/still.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

/// Scalar twins of the steps that draw the output, in double precision and grey levels.
namespace mfar::simd::oracle {

/// One channel; positions outside are held at the border.
struct Plane {
    Size size;
    std::vector<double> values;

    template <class F>
    static Plane of(Size size, const F& valueAt) {
        Plane out{size, {}};
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                out.values.push_back(valueAt(x, y));
        return out;
    }
    [[nodiscard]] double at(int x, int y) const {
        return values[static_cast<std::size_t>(std::clamp(y, 0, size.height - 1)) * size.width +
                      std::clamp(x, 0, size.width - 1)];
    }
    [[nodiscard]] double bilinear(double x, double y) const {
        const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
        return std::lerp(std::lerp(at(i, j), at(i + 1, j), x - i),
                         std::lerp(at(i, j + 1), at(i + 1, j + 1), x - i), y - j);
    }
    [[nodiscard]] double cubic(double x, double y, bool linear = false) const {
        if (linear) return bilinear(x, y);
        const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
        double sum = 0;
        for (int row = -1; row < 3; ++row)
            for (int column = -1; column < 3; ++column)
                sum += keys(column - (x - i)) * keys(row - (y - j)) * at(i + column, j + row);
        return sum;
    }

private:
    static double keys(double d) {
        const double a = params::kCubicSlope;
        d = std::abs(d);
        return d <= 1 ? (a + 2) * d * d * d - (a + 3) * d * d + 1
                      : a * (d * d * d - 5 * d * d + 8 * d - 4);
    }
};

/// Position of a result's pixel in the source.
inline double centre(int x, int from, int to) {
    return (x + 0.5) * from / to - 0.5;
}

inline Plane enlarged(const Plane& p, Size to, bool linear = false) {
    return Plane::of(to, [&](int x, int y) {
        return p.cubic(centre(x, p.size.width, to.width), centre(y, p.size.height, to.height),
                       linear);
    });
}

/// `strengthAt`: of a pixel.
inline Plane sharpened(const Plane& p, const std::function<double(int, int)>& strengthAt) {
    constexpr double kNear = params::kSharpenNear, kFar = params::kSharpenFar;
    return Plane::of(p.size, [&](int x, int y) {
        const double c = p.at(x, y);
        const double near = p.at(x - 1, y) + p.at(x + 1, y) + p.at(x, y - 1) + p.at(x, y + 1);
        const double far = p.at(x - 2, y) + p.at(x + 2, y) + p.at(x, y - 2) + p.at(x, y + 2);
        const double diagonal =
            p.at(x - 1, y - 1) + p.at(x + 1, y - 1) + p.at(x - 1, y + 1) + p.at(x + 1, y + 1);
        const double high = kNear * (near - 4 * c) + kFar * (far - 4 * c) +
                            kNear * kNear * (diagonal - 2 * near + 4 * c);
        return std::clamp(c + strengthAt(x, y) * high, 0.0, 255.0);
    });
}

/// Tent filter along both axes; see still_reduce.frag.
inline Plane reduced(const Plane& p, Size to) {
    const auto along = [](int from, int wanted, int i, const auto& valueAt) {
        const double scale = static_cast<double>(from) / wanted, at = centre(i, from, wanted);
        double sum = 0, weights = 0;
        for (int k = static_cast<int>(std::floor(at - scale)); k <= at + scale; ++k) {
            const double weight = std::max(0.0, scale - std::abs(k - at));
            sum += weight * valueAt(k);
            weights += weight;
        }
        return sum / weights;
    };
    const Plane narrow = Plane::of({to.width, p.size.height}, [&](int x, int y) {
        return along(p.size.width, to.width, x, [&](int k) { return p.at(k, y); });
    });
    return Plane::of(to, [&](int x, int y) {
        return along(p.size.height, to.height, y, [&](int k) { return narrow.at(x, k); });
    });
}

/// See still_low.frag and still_detail.frag.
inline Plane detail(const Plane& luma, Size lowSize, double neighbours) {
    const Plane low = Plane::of(lowSize, [&](int x, int y) {
        double sum = 0;
        for (int i = 0; i < 16; ++i) {
            const int column = i % 4, row = i / 4;
            const double dx = (column - 1.5) * 0.25 * params::kFootprint,
                         dy = (row - 1.5) * 0.25 * params::kFootprint;
            sum += luma.bilinear((x + 0.5 + dx) * luma.size.width / lowSize.width - 0.5,
                                 (y + 0.5 + dy) * luma.size.height / lowSize.height - 0.5);
        }
        return sum / 16;
    });
    const Plane up = enlarged(low, luma.size);
    return Plane::of(luma.size, [&](int x, int y) {
        const double here = luma.at(x, y), beside = luma.at(x - 1, y) + luma.at(x + 1, y) +
                                                    luma.at(x, y - 1) + luma.at(x, y + 1);
        const double value = here + neighbours * (4 * here - beside) - up.at(x, y) + 128;
        return std::clamp(value, 0.0, 255.0);
    });
}

template <class Row>
double worst(const Plane& wanted, const Row& rows) {
    double out = 0;
    for (int y = 0; y < wanted.size.height; ++y)
        for (int x = 0; x < wanted.size.width; ++x)
            out = std::max(out, std::abs(wanted.at(x, y) - rows[y][x]));
    return out;
}

}  // namespace mfar::simd::oracle
