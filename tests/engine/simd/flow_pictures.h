#pragma once

#include "base/geometry.h"
#include "base/rows.h"
#include "base/workers.h"
#include "pipeline/plan/rgb_planes.h"
#include "pipeline/plan/tile_work.h"
#include "tests/oracle/luma.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

namespace mfar::simd {

struct FlowPicture {
    explicit FlowPicture(Size s, std::uint8_t fill = 0)
        : size(s), pixels(static_cast<std::size_t>(s.width) * s.height, fill) {}
    [[nodiscard]] Rows<const std::uint8_t> rows() const {
        return {pixels.data(), size.width, size};
    }
    [[nodiscard]] std::uint8_t& at(int x, int y) {
        return pixels[static_cast<std::size_t>(y) * size.width + x];
    }

    Size size;
    std::vector<std::uint8_t> pixels;
};

/// A sum of plane waves of 6 to 80 px. Content that is at x without a shift appears at x + `shift`.
/// `stretch`: factor by which the content is stretched along x, away from the left border.
inline FlowPicture wavesMoved(Size size, Eigen::Vector2d shift, double gain = 1, double offset = 0,
                              unsigned seed = 1, double stretch = 1) {
    constexpr int kWaves = 24;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<double> sum(static_cast<std::size_t>(size.width) * size.height, 128);
    for (int i = 0; i < kWaves; ++i) {
        const double k = 2 * std::numbers::pi / (6 * std::pow(80.0 / 6, unit(random)));
        const double angle = 2 * std::numbers::pi * unit(random);
        const double phase = 2 * std::numbers::pi * unit(random);
        const double kx = k * std::cos(angle), ky = k * std::sin(angle);
        std::vector<double> sine(static_cast<std::size_t>(size.width)), cosine(sine.size());
        for (std::size_t x = 0; x < sine.size(); ++x) {
            const double p = kx * (static_cast<double>(x) - shift.x()) / stretch + phase;
            sine[x] = 9 * std::sin(p);
            cosine[x] = 9 * std::cos(p);
        }
        for (int y = 0; y < size.height; ++y) {
            const double p = ky * (y - shift.y());
            const double s = std::sin(p), c = std::cos(p);
            double* row = &sum[static_cast<std::size_t>(y) * size.width];
            for (std::size_t x = 0; x < sine.size(); ++x)
                row[x] += sine[x] * c + cosine[x] * s;
        }
    }
    FlowPicture out(size);
    for (std::size_t i = 0; i < sum.size(); ++i)
        out.pixels[i] = static_cast<std::uint8_t>(
            std::lround(std::clamp(gain * (sum[i] - 128) + 128 + offset, 0.0, 255.0)));
    return out;
}

[[nodiscard]] inline twin::Grey greyOf(const FlowPicture& p) {
    return {p.size, {p.pixels.begin(), p.pixels.end()}};
}

inline FlowPicture noiseOf(Size size, unsigned seed) {
    FlowPicture out(size);
    std::mt19937 random(seed);
    for (std::uint8_t& v : out.pixels)
        v = static_cast<std::uint8_t>(random() >> 24);
    return out;
}

inline RgbPlanes planesOf(const FlowPicture& p) {
    RgbPlanes out(p.size);
    out.take({p.pixels.data(), p.size, static_cast<std::size_t>(p.size.width), PixelFormat::Gray8});
    return out;
}

[[nodiscard]] inline const std::shared_ptr<Workers>& twoWorkers() {
    static const auto shared = std::make_shared<Workers>(2);
    return shared;
}

inline TileWork wholeWork(Size video) {
    TileWork work;
    work.tiles = tilesOf(video);
    const int count = work.tiles.width * work.tiles.height;
    work.flags.assign(static_cast<std::size_t>(count), {1, 1});
    work.changed = work.matched = count;
    work.noise = 0.29;
    return work;
}

inline StereoRig rigOf(Size video, Size still) {
    CameraModel v;
    v.size = video;
    v.fx = v.fy = video.width;
    v.cx = 0.5 * (video.width - 1);
    v.cy = 0.5 * (video.height - 1);
    return {v, v.scaledTo(still), {}};
}

}  // namespace mfar::simd
