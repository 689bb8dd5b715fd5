#include "hal/virtual/synthetic_hash.h"
#include "hal/virtual/synthetic_textures.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mfar::synthetic {
namespace {

int wrap(int i) {
    return (i % kLayerSize + kLayerSize) % kLayerSize;
}

cv::Mat4b wood(std::uint64_t seed) {
    const cv::Mat1f bend = fractal(seed, 2, 6, 3);
    const cv::Mat1f fibre = fractal(seed + 1, 16, 256, 2, 0.8F);
    const cv::Mat1f pores = noise(seed + 2, 40, 512);
    const cv::Mat1f tone = fractal(seed + 3, 2, 24, 3);
    cv::Mat3f colour(kLayerSize, kLayerSize);
    eachPixel(colour, [&](cv::Vec3f& c, const int* at) {
        const float ring = (static_cast<float>(at[0]) / kLayerSize * 9 + bend(at) * 3.5F);
        const float saw = ring - std::floor(ring);
        const float late = std::pow(saw, 4.F) * (1 - std::pow(saw, 24.F));
        float v = 0.72F + 0.25F * (tone(at) - 0.5F) + 0.35F * (fibre(at) - 0.5F);
        v *= 1 - 0.35F * late;
        if (pores(at) > 0.80F) v *= 1 - 1.6F * (pores(at) - 0.80F) / 0.2F * (0.3F + 0.5F * late);
        c = cv::Vec3f{0.52F, 0.33F, 0.18F} * v * 1.15F;
    });
    cv::Mat1f gloss;
    fibre.convertTo(gloss, CV_32F, 0.2, 0.15);
    return toBytes(colour, gloss);
}

cv::Mat4b bark(std::uint64_t seed) {
    const cv::Mat1f ridges = fractal(seed, 14, 4, 3, 0.55F);
    const cv::Mat1f cracks = fractal(seed + 1, 10, 26, 3, 0.6F);
    const cv::Mat1f fine = fractal(seed + 2, 96, 48, 4, 0.7F);
    cv::Mat1f height(kLayerSize, kLayerSize);
    eachPixel(height, [&](float& h, const int* at) {
        const float fissure = 1 - std::abs(2 * ridges(at) - 1);
        const float crack = 1 - std::abs(2 * cracks(at) - 1);
        h = 1.6F - 2.2F * std::pow(fissure, 3.F) - 0.5F * std::pow(crack, 6.F) + 0.45F * fine(at);
    });
    const cv::Mat1f shade = relief(height, 1.4F), lichen = fractal(seed + 4, 9, 9, 4, 0.6F);
    cv::Mat3f colour(kLayerSize, kLayerSize);
    eachPixel(colour, [&](cv::Vec3f& c, const int* at) {
        const float depth = std::clamp(0.25F + 0.45F * height(at), 0.08F, 1.F);
        const float moss = std::clamp((lichen(at) - 0.62F) * 6, 0.F, 0.8F);
        const cv::Vec3f brown = cv::Vec3f{0.34F, 0.26F, 0.19F} * (0.7F + 0.6F * fine(at));
        c = (brown * (1 - moss) + cv::Vec3f{0.30F, 0.36F, 0.20F} * moss) * depth * shade(at);
    });
    return toBytes(colour, cv::Mat1f(colour.size(), 0.F));
}

/// Paints a leaf at (x, y) [texels]. A leaf that crosses the edge of the texture continues at the
/// opposite edge.
void paintLeaf(cv::Mat3f& canvas, Random& random, double x, double y, float depth) {
    const double angle = random.range(0, 2 * std::numbers::pi);
    const double length = random.range(20, 46), width = length * random.range(0.28, 0.45);
    const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
    const auto l = static_cast<float>(length), w = static_cast<float>(width);
    const auto yellow = static_cast<float>(random.unit());
    const auto tilt = static_cast<float>(random.range(0.55, 1.25));
    const cv::Vec3f green =
        cv::Vec3f{0.13F + 0.17F * yellow * yellow, 0.22F + 0.10F * yellow, 0.075F} * tilt * depth;
    const int reach = static_cast<int>(length) + 2;
    for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
            const auto fx = static_cast<float>(dx), fy = static_cast<float>(dy);
            const float along = (fx * c + fy * s) / l, across = (fy * c - fx * s) / w;
            const float rim = (1 - along * along) * (0.75F - 0.25F * along);
            if (!(std::abs(along) < 1 && std::abs(across) < rim)) continue;
            const float vein = std::abs(across) < 0.07F ? 1.5F : 1.F;
            const float ribs =
                std::sin((along * 1.0F + std::abs(across) * 0.6F) * l * 0.9F) > 0.6F ? 0.86F : 1.F;
            const float side = across > 0 ? 1.12F : 0.86F;
            const float edge = std::abs(across) > rim - 0.12F ? 0.8F : 1.F;
            canvas(wrap(static_cast<int>(y) + dy), wrap(static_cast<int>(x) + dx)) =
                green * (vein * ribs * side * edge);
        }
    }
}

cv::Mat4b foliage(std::uint64_t seed) {
    constexpr int kLeaves = 5200;
    cv::Mat3f colour(kLayerSize, kLayerSize, cv::Vec3f{0.012F, 0.02F, 0.008F});
    Random random(seed);
    for (int i = 0; i < kLeaves; ++i) {
        const float depth = 0.16F + 0.95F * std::pow(static_cast<float>(i) / kLeaves, 2.F);
        const double x = random.range(0, kLayerSize), y = random.range(0, kLayerSize);
        // Leaves are painted in clumps, so that deeper, darker leaves stay visible between them.
        const double clump = std::sin(x * 0.0368155) * std::sin(y * 0.0429515 + 1) +
                             std::sin(x * 0.0122718 + y * 0.0184078);
        if (i > kLeaves / 3 && clump < random.range(-1.6, 0.6)) continue;
        paintLeaf(colour, random, x, y, depth);
    }
    return toBytes(colour, cv::Mat1f(colour.size(), 0.25F));
}

/// The distances from a texel to the nearest and the second nearest of many random points. There is
/// one random point in each square of a grid. The grid continues at the opposite edge.
struct Cell {
    float nearest, second;
    std::uint64_t id;
};

Cell cellAt(std::uint64_t seed, int cells, float x, float y) {
    const int cx = static_cast<int>(std::floor(x)), cy = static_cast<int>(std::floor(y));
    Cell out{9, 9, 0};
    for (int j = cy - 1; j <= cy + 1; ++j) {
        for (int i = cx - 1; i <= cx + 1; ++i) {
            const auto id = hash(seed, (i + cells) % cells, (j + cells) % cells);
            const float px = static_cast<float>(i) + static_cast<float>(hashUnit(id));
            const float py = static_cast<float>(j) + static_cast<float>(hashUnit(mix(id)));
            const float d = std::hypot(px - x, py - y);
            if (d < out.nearest) {
                out.second = out.nearest;
                out.nearest = d;
                out.id = id;
            } else if (d < out.second) {
                out.second = d;
            }
        }
    }
    return out;
}

cv::Mat4b gravel(std::uint64_t seed) {
    constexpr int kCells = 30;
    const cv::Mat1f rough = fractal(seed + 5, 64, 64, 4, 0.7F);
    cv::Mat1f height(kLayerSize, kLayerSize);
    cv::Mat3f colour(kLayerSize, kLayerSize);
    eachPixel(colour, [&](cv::Vec3f& c, const int* at) {
        const float x = static_cast<float>(at[1]) / kLayerSize * kCells;
        const float y = static_cast<float>(at[0]) / kLayerSize * kCells;
        const Cell cell = cellAt(seed, kCells, x, y);
        const float stone = std::min(1.F, (cell.second - cell.nearest) * 2.6F);
        const auto tone = 0.35F + 0.75F * static_cast<float>(hashUnit(mix(cell.id + 1)));
        const auto warm = static_cast<float>(hashUnit(mix(cell.id + 2)));
        height(at) = 2.2F * std::sqrt(stone) + 0.6F * rough(at);
        c = cv::Vec3f{0.40F, 0.37F - 0.03F * warm, 0.34F - 0.08F * warm} *
            (tone * (0.35F + 0.65F * stone) * (0.6F + 0.8F * rough(at)));
    });
    const cv::Mat1f shade = relief(height, 1.1F);
    eachPixel(colour, [&](cv::Vec3f& c, const int* at) { c *= shade(at); });
    return toBytes(colour, cv::Mat1f(colour.size(), 0.F));
}

cv::Mat4b forest(std::uint64_t seed) {
    const cv::Mat1f cloud = fractal(seed, 3, 6, 6, 0.6F);
    const cv::Mat1f crown = fractal(seed + 1, 12, 1, 7, 0.62F);
    const cv::Mat1f leaves = fractal(seed + 2, 60, 60, 4, 0.85F);
    const cv::Mat1f trees = fractal(seed + 3, 22, 9, 3, 0.6F);
    const cv::Mat1f twigs = noise(seed + 4, 400, 400);
    cv::Mat3f colour(kLayerSize, kLayerSize);
    eachPixel(colour, [&](cv::Vec3f& c, const int* at) {
        const float v = static_cast<float>(at[0]) / kLayerSize;
        const float line = 0.34F + 0.22F * crown(512, at[1]) + 0.05F * (leaves(at) - 0.5F) +
                           0.02F * (twigs(at) - 0.5F);
        const float white = std::clamp((cloud(at) - 0.42F) * 2.6F, 0.F, 1.F);
        const cv::Vec3f blue{0.26F + 0.25F * v, 0.42F + 0.25F * v, 0.72F + 0.12F * v};
        const cv::Vec3f sky = blue * (1 - white) + cv::Vec3f{0.86F, 0.86F, 0.87F} * white;
        const float lit = std::clamp(0.25F + 1.3F * (trees(at) - 0.3F), 0.1F, 1.1F) *
                          (0.25F + 1.3F * leaves(at)) * (0.6F + 0.8F * twigs(at));
        const float autumn = std::clamp((trees(at) - 0.55F) * 2.5F, 0.F, 0.7F);
        const cv::Vec3f wood = cv::Vec3f{0.13F + 0.20F * autumn, 0.21F + 0.02F * autumn, 0.08F};
        c = v < line ? sky : wood * lit + cv::Vec3f{0.03F, 0.045F, 0.06F};
    });
    return toBytes(colour, cv::Mat1f(colour.size(), 0.F));
}

}  // namespace

cv::Mat4b makeNature(Layer layer, std::uint64_t seed) {
    switch (layer) {
    case Layer::Wood: return wood(seed);
    case Layer::Bark: return bark(seed);
    case Layer::Foliage: return foliage(seed);
    case Layer::Gravel: return gravel(seed);
    default: return forest(seed);
    }
}

}  // namespace mfar::synthetic
