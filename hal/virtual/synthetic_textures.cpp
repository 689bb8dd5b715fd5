#include "hal/virtual/synthetic_textures.h"

#include "hal/virtual/synthetic_hash.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace mfar::synthetic {
namespace {

cv::Mat4b plaster(std::uint64_t seed) {
    const cv::Mat1f height = fractal(seed, 48, 48, 4, 0.6F);
    const cv::Mat1f shade = relief(height, 2.2F);
    const cv::Mat1f stains = fractal(seed + 1, 4, 4, 4);
    cv::Mat3f colour(kLayerSize, kLayerSize);
    eachPixel(colour, [&](cv::Vec3f& c, const int* at) {
        const float v = shade(at) * (0.66F + 0.10F * stains(at));
        c = {v, v * 0.97F, v * (0.90F + 0.04F * stains(at))};
    });
    return toBytes(colour, cv::Mat1f(colour.size(), 0.05F));
}

cv::Mat4b weave(std::uint64_t seed) {
    constexpr int kThread = 16;
    constexpr int kThreads = kLayerSize / kThread;
    const cv::Mat1f fuzz = fractal(seed, 128, 128, 3, 0.7F);
    cv::Mat3f colour(kLayerSize, kLayerSize);
    eachPixel(colour, [&](cv::Vec3f& c, const int* at) {
        const int tx = at[1] / kThread, ty = at[0] / kThread;
        const float x = (static_cast<float>(at[1] % kThread) + 0.5F) / kThread * 2 - 1;
        const float y = (static_cast<float>(at[0] % kThread) + 0.5F) / kThread * 2 - 1;
        const bool warp = (tx + ty) % 2 == 0;
        const float across = warp ? x : y, along = warp ? y : x;
        const float round = std::sqrt(std::max(0.F, 1 - across * across));
        const float sag = 1 - 0.45F * along * along;
        const auto h = hash(seed, warp ? tx % kThreads : ty % kThreads + 1000, 7);
        const float dye = 0.75F + 0.4F * static_cast<float>(hashUnit(h));
        const float v = (0.12F + 0.6F * round * sag) * dye * (0.7F + 0.6F * fuzz(at));
        c = warp ? cv::Vec3f{v, v * 0.96F, v * 0.9F} : cv::Vec3f{v * 0.85F, v * 0.9F, v};
    });
    return toBytes(colour, cv::Mat1f(colour.size(), 0.02F));
}

cv::Mat4b brick(std::uint64_t seed) {
    constexpr int kAcross = 4, kRows = 12;
    constexpr float kWide = 1.F * kLayerSize / kAcross, kHigh = 1.F * kLayerSize / kRows;
    const cv::Mat1f rough = fractal(seed, 40, 40, 5, 0.65F);
    const cv::Mat1f wobble = fractal(seed + 1, 24, 24, 3);
    cv::Mat1f height(kLayerSize, kLayerSize);
    cv::Mat3f colour(kLayerSize, kLayerSize);
    eachPixel(colour, [&](cv::Vec3f& c, const int* at) {
        const float bend = (wobble(at) - 0.5F) * 10;
        const float py = static_cast<float>(at[0]) + bend;
        const int row = static_cast<int>(std::floor(py / kHigh)) + kRows;
        const float px = static_cast<float>(at[1]) + bend + (row % 2 != 0 ? kWide / 2 : 0);
        const int column = static_cast<int>(std::floor(px / kWide)) + kAcross;
        const float dx = px - (static_cast<float>(column - kAcross) + 0.5F) * kWide;
        const float dy = py - (static_cast<float>(row - kRows) + 0.5F) * kHigh;
        const float edge = std::min(kWide / 2 - std::abs(dx), kHigh / 2 - std::abs(dy));
        const float stone = std::clamp((edge - 5.F) / 5.F, 0.F, 1.F);
        const auto h = hash(seed, row % kRows, column % kAcross);
        const float tone = 0.7F + 0.6F * static_cast<float>(hashUnit(h));
        const float soot = static_cast<float>(hashUnit(mix(h)));
        const cv::Vec3f clay = cv::Vec3f{0.42F, 0.17F + 0.05F * soot, 0.10F + 0.06F * soot} * tone;
        const cv::Vec3f mortar{0.50F, 0.48F, 0.44F};
        c = (clay * stone + mortar * (1 - stone)) * (0.65F + 0.7F * rough(at));
        height(at) = 1.4F * stone + 0.9F * rough(at);
    });
    const cv::Mat1f shade = relief(height, 0.8F);
    eachPixel(colour, [&](cv::Vec3f& c, const int* at) { c *= shade(at); });
    return toBytes(colour, cv::Mat1f(colour.size(), 0.03F));
}

cv::Mat4b enamel(std::uint64_t seed) {
    const cv::Mat1f grain = noise(seed, 512, 512), soft = fractal(seed + 1, 16, 16, 3);
    cv::Mat3f colour(kLayerSize, kLayerSize);
    eachPixel(colour, [&](cv::Vec3f& c, const int* at) {
        const float speck = grain(at) > 0.93F ? 0.82F : 1.F;
        const float v = (0.84F + 0.06F * soft(at)) * speck;
        c = {v, v, v};
    });
    return toBytes(colour, cv::Mat1f(colour.size(), 1.F));
}

cv::Mat4b clouds(std::uint64_t seed) {
    const cv::Mat1f f = fractal(seed, 6, 6, 5, 0.55F);
    cv::Mat3f colour(kLayerSize, kLayerSize);
    eachPixel(colour, [&](cv::Vec3f& c, const int* at) { c = cv::Vec3f::all(f(at)); });
    return toBytes(colour, f);
}

}  // namespace

cv::Mat1f noise(std::uint64_t seed, int cellsX, int cellsY) {
    constexpr int kPad = 3;
    cv::Mat1f grid(cellsY, cellsX);
    for (int y = 0; y < cellsY; ++y)
        for (int x = 0; x < cellsX; ++x)
            grid(y, x) = static_cast<float>(hashUnit(hash(seed, x, y)));
    cv::Mat1f padded;
    cv::copyMakeBorder(grid, padded, kPad, kPad, kPad, kPad, cv::BORDER_WRAP);
    // cv::resize() would also enlarge the padding. The padding could not be cut off exactly,
    // because kLayerSize need not be a multiple of the number of cells.
    const double sx = 1. * cellsX / kLayerSize, sy = 1. * cellsY / kLayerSize;
    const cv::Matx23d toGrid{sx, 0, kPad + 0.5 * sx - 0.5, 0, sy, kPad + 0.5 * sy - 0.5};
    cv::Mat1f out;
    cv::warpAffine(padded, out, toGrid, {kLayerSize, kLayerSize},
                   cv::INTER_CUBIC | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
    return out;
}

cv::Mat1f fractal(std::uint64_t seed, int cellsX, int cellsY, int octaves, float gain) {
    cv::Mat1f sum(kLayerSize, kLayerSize, 0.F);
    float weight = 1, total = 0;
    for (int i = 0; i < octaves; ++i, weight *= gain) {
        const int nx = std::min(cellsX << i, kLayerSize / 2);
        const int ny = std::min(cellsY << i, kLayerSize / 2);
        const cv::Mat1f octave = noise(seed + 77 * static_cast<std::uint64_t>(i), nx, ny);
        eachPixel(sum, [&](float& v, const int* at) { v += weight * (octave(at) - 0.5F); });
        total += weight;
    }
    // The weighted mean of independent octaves varies less than each of them, so its difference
    // from 0.5 is multiplied by 1.5.
    eachPixel(sum, [&](float& v, const int*) { v = v * 1.5F / total + 0.5F; });
    return sum;
}

cv::Mat1f relief(const cv::Mat1f& height, float strength) {
    cv::Mat1f out(height.size());
    eachPixel(out, [&](float& v, const int* at) {
        const int left = (at[1] + kLayerSize - 1) % kLayerSize,
                  up = (at[0] + kLayerSize - 1) % kLayerSize;
        const float slope = 2 * height(at) - height(at[0], left) - height(up, at[1]);
        v = std::clamp(1 + strength * slope, 0.25F, 1.8F);
    });
    return out;
}

cv::Mat4b toBytes(const cv::Mat3f& colour, const cv::Mat1f& gloss) {
    cv::Mat4b out(colour.size());
    eachPixel(out, [&](cv::Vec4b& o, const int* at) {
        const cv::Vec3f& c = colour(at);
        for (int k = 0; k < 3; ++k)
            o[k] = cv::saturate_cast<unsigned char>(c[k] * 255);
        o[3] = cv::saturate_cast<unsigned char>(gloss(at) * 255);
    });
    return out;
}

cv::Mat4b makeLayer(Layer layer, std::uint64_t seed) {
    const std::uint64_t own = hash(seed, static_cast<int>(layer), 101);
    switch (layer) {
    case Layer::Plaster: return plaster(own);
    case Layer::Weave: return weave(own);
    case Layer::Brick: return brick(own);
    case Layer::Enamel: return enamel(own);
    case Layer::Clouds: return clouds(own);
    case Layer::Wood:
    case Layer::Bark:
    case Layer::Foliage:
    case Layer::Gravel:
    case Layer::Forest: return makeNature(layer, own);
    default: return makePrint(layer, own);
    }
}

}  // namespace mfar::synthetic
