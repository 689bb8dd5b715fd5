#include "tests/stability/half_precision.h"

#include "base/image_layout.h"
#include "tests/stability/error_table.h"
#include "tests/stability/hostile.h"

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mfar::stress {
namespace {

using Eigen::half;

constexpr int kDraws = 20000;
constexpr double kMostLevels = 0.5;   // largest allowed error of a colour [grey levels]
constexpr double kMostPixels = 0.05;  // largest allowed error of a position [px]

template <class T>
std::array<T, 4> cubicWeights(T t) {
    const T a(-0.75), one(1), s = one - t;
    const T w0 = a * t * s * s, w3 = a * s * t * t;
    const T w1 = ((a + T(2)) * t - (a + T(3))) * t * t + one;
    return {w0, w1, one - w0 - w1 - w3, w3};
}

template <class T>
T weighed(const std::array<T, 4>& w, const std::array<double, 4>& v) {
    return w[0] * T(v[0]) + w[1] * T(v[1]) + w[2] * T(v[2]) + w[3] * T(v[3]);
}

/// Position of output column x between two video pixels, from 0 to 1: the fractional part of
/// x * scale - 0.5.
template <class T>
T fractionAt(double x, double scale) {
    const T p = T(x) * T(scale) - T(0.5);
    return p - T(std::floor(static_cast<double>(p)));
}

template <class T>
T channelOf(const std::array<float, 4>& row, const std::array<double, 3>& yuv) {
    return T(row[0]) * T(yuv[0]) + T(row[1]) * T(yuv[1]) + T(row[2]) * T(yuv[2]) + T(row[3] / 255);
}

template <class T>
T meanOf16(const std::array<double, 16>& v) {
    T sum(0);
    for (const double x : v)
        sum = sum + T(x);
    return sum / T(16);
}

template <class T>
T projected(const CameraModel& c, double x, double y) {
    const T u(x), v(y), r2 = u * u + v * v;
    const auto k = [&](int i) { return T(c.distortion[static_cast<std::size_t>(i)]); };
    const T radial = T(1) + r2 * (k(0) + r2 * (k(1) + r2 * k(4)));
    const T bent = u * radial + T(2) * k(2) * u * v + k(3) * (r2 + T(2) * u * u);
    return T(c.fx) * bent + T(c.cx);
}

template <class T>
T likenessOf(double distance, double strength) {
    const T d(distance);
    return T(std::exp(static_cast<double>(T(0) - T(strength) * (d * d))));
}

void printVerdict(ErrorTable& table, double most) {
    table.print();
    fmt::print("    {}\n", table.worst() <= most ? "may use mediump" : "needs highp");
}

void colours(Hostile& h) {
    ErrorTable yuv("picture_from_yuv: R G B", "grey levels"),
        taps("enlargement: weights and sums", "grey levels");
    ErrorTable places("enlargement: position and weights", "grey levels"),
        mean("superres_sharpen: mean", "grey levels");
    ErrorTable detail("composite_detail: sum", "grey levels"),
        blend("visibility_blend: colour", "grey levels");
    ErrorTable likeness("visibility_sample: likeness", "1/255");
    const YuvToRgb rows = yuvToRgb(YuvMatrix::Bt709, YuvRange::Limited);
    const auto level = [&] { return h.integer(0, 255) / 255.0; };
    for (int i = 0; i < kDraws; ++i) {
        const std::array<double, 3> c{level(), level(), level()};
        const auto& row = rows[static_cast<std::size_t>(h.integer(0, 2))];
        const auto clamped = [](double v) { return std::clamp(v, 0.0, 1.0); };
        yuv.add(255 * std::abs(clamped(static_cast<double>(channelOf<half>(row, c))) -
                               clamped(channelOf<double>(row, c))));
        const std::array<double, 4> v{level(), level(), level(), level()};
        const double scale = 640.0 / 2304, x = h.integer(0, 2303) + 0.5;
        const double fraction = fractionAt<double>(x, scale);
        const double wanted = weighed(cubicWeights(fraction), v);
        taps.add(255 *
                 std::abs(static_cast<double>(weighed(cubicWeights(half(fraction)), v)) - wanted));
        const half placed = fractionAt<half>(x, scale);
        places.add(255 * std::abs(static_cast<double>(weighed(cubicWeights(placed), v)) - wanted));
        std::array<double, 16> sixteen{};
        for (double& one : sixteen)
            one = level();
        mean.add(255 * std::abs(static_cast<double>(meanOf16<half>(sixteen)) -
                                meanOf16<double>(sixteen)));
        const double l = h.real(0, 2.3), d = level() - level();
        detail.add(255 *
                   std::abs(static_cast<double>(half(c[0]) + half(l) * half(d)) - (c[0] + l * d)));
        blend.add(255 * std::abs(static_cast<double>(half(c[0]) * half(c[1])) - c[0] * c[1]));
        likeness.add(255 * std::abs(static_cast<double>(likenessOf<half>(c[0], 225.8)) -
                                    likenessOf<double>(c[0], 225.8)));
    }
    for (ErrorTable* one : {&yuv, &taps, &places, &mean, &detail, &blend, &likeness})
        printVerdict(*one, kMostLevels);
}

void places(Hostile& h) {
    ErrorTable lens("rig, lens: still pixel", "px"), look("look-up: position in the still", "px");
    ErrorTable stored("superres_weigh: offset in rgba16f", "px");
    const CameraModel still{{2304, 1728}, 2300, 2300, 1150, 860, {-0.12, 0.03, 1e-3, -2e-3, 0}};
    for (int i = 0; i < kDraws; ++i) {
        const double x = h.real(-0.5, 0.5), y = h.real(-0.37, 0.37);
        lens.add(std::abs(static_cast<double>(projected<half>(still, x, y)) -
                          projected<double>(still, x, y)));
        const double at = h.integer(0, 2303) + 0.5, offset = h.real(-40, 40);
        look.add(std::abs(static_cast<double>(half(at) + half(offset)) - (at + offset)));
        stored.add(std::abs(static_cast<double>(half(offset)) - offset));
    }
    for (ErrorTable* one : {&lens, &look, &stored})
        printVerdict(*one, kMostPixels);
}

}  // namespace

void printHalfPrecision() {
    Hostile hostile(1);
    fmt::print("\nHalf precision, emulated\n");
    ErrorTable::printHead();
    colours(hostile);
    places(hostile);
}

}  // namespace mfar::stress
