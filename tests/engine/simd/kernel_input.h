#pragma once

#include "pipeline/simd/lens.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace mfar::test {

/// Lengths that are multiples of the vector length, and others.
inline constexpr std::array<std::size_t, 8> kLengths{1, 2, 3, 7, 16, 33, 64, 131};

template <class T>
std::vector<T> randomValues(std::size_t count, double low, double high, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(low, high);
    std::vector<T> out(count);
    for (T& v : out)
        v = static_cast<T>(value(random));
    return out;
}

struct Ray {
    double x, y;
};

inline simd::Lens barrel() {
    return {100, 102, 49, 38, -0.1F, 0.02F, 0.001F, -0.002F, 0.003F, 4};
}

/// Projects with the Brown-Conrady model in double precision. Valid for rays within Lens::rim2.
inline Ray project(const simd::Lens& lens, double x, double y) {
    const double q = x * x + y * y;
    const double radial = 1 + lens.k1 * q + lens.k2 * q * q + lens.k3 * q * q * q;
    return {lens.fx * (x * radial + 2 * lens.p1 * x * y + lens.p2 * (q + 2 * x * x)) + lens.cx,
            lens.fy * (y * radial + 2 * lens.p2 * x * y + lens.p1 * (q + 2 * y * y)) + lens.cy};
}

inline std::array<float, 9> smallTurn() {
    const double c = std::cos(0.1), s = std::sin(0.1);
    const auto f = [](double v) { return static_cast<float>(v); };
    return {f(c), f(-s * c), f(s * s), f(s), f(c * c), f(-c * s), 0, f(s), f(c)};
}

struct Point3 {
    double x, y, z;
};
inline Point3 turned(const std::array<float, 9>& r, const Point3& p) {
    return {r[0] * p.x + r[1] * p.y + r[2] * p.z, r[3] * p.x + r[4] * p.y + r[5] * p.z,
            r[6] * p.x + r[7] * p.y + r[8] * p.z};
}

/// True if a coordinate is so near the border between two pixels that rounding errors can
/// decide to which one it belongs.
inline bool isBetween(double v) {
    const double part = v + 0.5 - std::floor(v + 0.5);
    return part < 0.01 || part > 0.99;
}

}  // namespace mfar::test
