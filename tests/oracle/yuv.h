#pragma once

#include "base/image_view.h"

#include <algorithm>
#include <array>
#include <cmath>

/// Oracle of picture_from_yuv.frag in double precision, with the coefficients that the standards
/// print.
namespace mfar::twin {

struct Samples {
    const std::uint8_t* data;
    std::size_t stride;
    int step, width, height;

    [[nodiscard]] double at(int x, int y) const {
        x = std::clamp(x, 0, width - 1);
        y = std::clamp(y, 0, height - 1);
        return data[y * stride + 1UL * x * step];
    }
    [[nodiscard]] double bilinear(double x, double y) const {
        const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
        return std::lerp(std::lerp(at(x0, y0), at(x0 + 1, y0), x - x0),
                         std::lerp(at(x0, y0 + 1), at(x0 + 1, y0 + 1), x - x0), y - y0);
    }
};

inline std::array<Samples, 3> yuvSamples(const ImageView& v) {
    const int w = v.size.width, h = v.size.height;
    if (v.format == PixelFormat::Yuyv)
        return {Samples{v.data, v.stride, 2, w, h}, Samples{v.data + 1, v.stride, 4, w / 2, h},
                Samples{v.data + 3, v.stride, 4, w / 2, h}};
    const bool pairs = v.format == PixelFormat::Nv12;
    const PlaneView u = v.chroma[0];
    const PlaneView second = pairs ? PlaneView{u.data + 1, u.stride} : v.chroma[1];
    const int step = pairs ? 2 : 1;
    return {Samples{v.data, v.stride, 1, w, h}, Samples{u.data, u.stride, step, w / 2, h / 2},
            Samples{second.data, second.stride, step, w / 2, h / 2}};
}

inline std::array<double, 3> rgbOfYuv(double y, double u, double v, const ImageView& of) {
    const bool full = of.range == YuvRange::Full, hd = of.matrix == YuvMatrix::Bt709;
    // Indices: range (limited, full), matrix (BT.601, BT.709), factor. Factors: of Y in all
    // channels, of V in R, U in G, V in G, U in B.
    constexpr double kTable[2][2][5] = {
        {{1.164384, 1.596027, -0.391762, -0.812968, 2.017232},
         {1.164384, 1.792741, -0.213249, -0.532909, 2.112402}},
        {{1, 1.402, -0.344136, -0.714136, 1.772}, {1, 1.5748, -0.187324, -0.468124, 1.8556}}};
    const double* k = kTable[full ? 1 : 0][hd ? 1 : 0];
    y = k[0] * (full ? y : y - 16);
    u -= 128;
    v -= 128;
    return {y + k[1] * v, y + k[2] * u + k[3] * v, y + k[4] * u};
}

/// Colour of a pixel of any format, 0 to 255, not rounded. Chroma is interpolated: a chroma sample
/// lies in the centre of the pixels that share it.
inline std::array<double, 3> rgbAt(const ImageView& picture, int x, int y) {
    const std::uint8_t* p =
        picture.data + y * picture.stride + 1UL * x * bytesPerPixel(picture.format);
    if (picture.format == PixelFormat::Gray8) return {double(p[0]), double(p[0]), double(p[0])};
    if (picture.format == PixelFormat::Rgba8) return {double(p[0]), double(p[1]), double(p[2])};
    if (picture.format == PixelFormat::Bgra8) return {double(p[2]), double(p[1]), double(p[0])};
    const auto [luma, u, v] = yuvSamples(picture);
    const double cx = (x + 0.5) / 2 - 0.5;
    const double cy = picture.format == PixelFormat::Yuyv ? y : (y + 0.5) / 2 - 0.5;
    auto rgb = rgbOfYuv(luma.at(x, y), u.bilinear(cx, cy), v.bilinear(cx, cy), picture);
    for (double& c : rgb)
        c = std::clamp(c, 0.0, 255.0);
    return rgb;
}

}  // namespace mfar::twin
