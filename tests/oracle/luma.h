#pragma once

#include "base/geometry.h"
#include "base/image_view.h"
#include "pipeline/engine/params/luma.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mfar::twin {

// kSmoothing: filter weight of each of the two neighbours along an axis, at the finest pyramid
// level. kBoxWidening widens a box filter so that it has the variance of box and smoothing
// together.
inline constexpr double kSmoothing = params::kLumaSmoothing;
inline const double kBoxWidening = std::sqrt(1 + 12 * 2 * kSmoothing);
using params::kFootprintTaps;

/// A picture of one channel. Positions outside it repeat the border.
struct Grey {
    Size size;
    std::vector<double> values;

    [[nodiscard]] double at(int x, int y) const {
        x = std::clamp(x, 0, size.width - 1);
        y = std::clamp(y, 0, size.height - 1);
        return values[static_cast<std::size_t>(y) * size.width + x];
    }
    [[nodiscard]] double bilinear(double x, double y) const {
        const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
        return std::lerp(std::lerp(at(x0, y0), at(x0 + 1, y0), x - x0),
                         std::lerp(at(x0, y0 + 1), at(x0 + 1, y0 + 1), x - x0), y - y0);
    }
};

template <class F>
Grey greyOf(Size size, F valueAt) {
    Grey out{size, {}};
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            out.values.push_back(valueAt(x, y));
    return out;
}

/// A row of `to` pixels and a row of `from` pixels cover the same length. Returns the position, in
/// the row of `from` pixels, of the centre of pixel `x` of the other row.
inline double centre(int x, int from, int to) {
    return (x + 0.5) * from / to - 0.5;
}

/// Largest absolute difference between `wanted`, clamped to [0, 255], and rows of bytes.
template <class Row>
double worst(const Grey& wanted, const Row& rows) {
    double out = 0;
    for (int y = 0; y < wanted.size.height; ++y)
        for (int x = 0; x < wanted.size.width; ++x)
            out = std::max(out, std::abs(std::clamp(wanted.at(x, y), 0.0, 255.0) - rows[y][x]));
    return out;
}

/// Rec. 601 luma in grey levels, not rounded.
inline Grey luma(const ImageView& v) {
    return greyOf(v.size, [&](int x, int y) {
        const std::uint8_t* p = v.data + y * v.stride + 1UL * x * bytesPerPixel(v.format);
        if (v.format == PixelFormat::Gray8) return double(p[0]);
        return double{params::kLumaRed} * p[0] + double{params::kLumaGreen} * p[1] +
               double{params::kLumaBlue} * p[2];
    });
}

inline Grey smoothed(const Grey& g) {
    const double weight[3] = {kSmoothing, 1 - 2 * kSmoothing, kSmoothing};
    return greyOf(g.size, [&](int x, int y) {
        double sum = 0;
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i)
                sum += weight[i] * weight[j] * g.at(x + i - 1, y + j - 1);
        return sum;
    });
}

inline Grey halved(const Grey& g) {
    return greyOf({(g.size.width + 1) / 2, (g.size.height + 1) / 2}, [&](int x, int y) {
        const double sum = g.at(2 * x, 2 * y) + g.at(2 * x + 1, 2 * y) + g.at(2 * x, 2 * y + 1) +
                           g.at(2 * x + 1, 2 * y + 1);
        return std::floor(0.25 * sum + 0.5);
    });
}

/// Still pixel that shows the same point as this video pixel if the point is infinitely far away.
inline Eigen::Vector2d stillPixel(const StereoRig& rig, const Eigen::Vector2d& videoPixel) {
    const Eigen::Vector3d ray =
        rig.T_still_video.rotation * rig.video.unproject(videoPixel).homogeneous();
    return rig.still.project(ray.hnormalized());
}

/// Resamples the still to the video's pixels. Each is the mean over its footprint in the still,
/// widened by kBoxWidening. `light`: Guidance::light.
inline Grey lumaFromStill(const Grey& still, const StereoRig& rig, double light) {
    const double footprint = kBoxWidening * rig.still.fx / rig.video.fx;
    return greyOf(rig.video.size, [&](int x, int y) {
        const Eigen::Vector2d q = stillPixel(rig, Eigen::Vector2d(x, y));
        double sum = 0, squares = 0;
        for (int j = 0; j < kFootprintTaps; ++j)
            for (int i = 0; i < kFootprintTaps; ++i) {
                const double value =
                    still.bilinear(q.x() + ((i + 0.5) / kFootprintTaps - 0.5) * footprint,
                                   q.y() + ((j + 0.5) / kFootprintTaps - 0.5) * footprint);
                sum += value;
                squares += value * value;
            }
        constexpr double kSamples = kFootprintTaps * kFootprintTaps;
        return std::lerp(sum / kSamples, std::sqrt(squares / kSamples), light);
    });
}

}  // namespace mfar::twin
