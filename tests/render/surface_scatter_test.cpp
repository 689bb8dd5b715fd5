#include "pipeline/render/sobol.h"
#include "pipeline/render/surface_scatter.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace mfar {
namespace {

Eigen::Vector3f directionAt(float mu, float phi) {
    const float r = std::sqrt(1 - mu * mu);
    return {r * std::cos(phi), r * std::sin(phi), mu};
}

std::vector<SurfaceLook> looks(const Eigen::Vector3f& colour) {
    std::vector<SurfaceLook> out;
    for (const float metallic : {0.0F, 0.5F, 1.0F})
        for (const float roughness : {0.15F, 0.5F, 1.0F})
            out.push_back({colour, metallic, roughness, false});
    out.push_back({colour, 0, 1, true});
    return out;
}

/// Returns the reflected light if radiance 1 arrives from all directions.
Eigen::Vector3f furnace(const SurfaceLook& look, float mu) {
    const SurfaceScatter scatter(look, directionAt(mu, 0.4F));
    Eigen::Vector3f sum{0, 0, 0};
    constexpr int kSamples = 4096;
    for (std::uint32_t i = 0; i < kSamples; ++i)
        sum += scatter.sample(PixelSampler(1, 2, i, false).pair(0)).weight;
    return sum / kSamples;
}

TEST(SurfaceScatter, WhiteSurfaceReflectsAllLight) {
    for (const SurfaceLook& look : looks({1, 1, 1}))
        for (const float mu : {0.1F, 0.4F, 0.7F, 1.0F})
            EXPECT_NEAR(furnace(look, mu).mean(), 1, 0.02)
                << look.metallic << ' ' << look.roughness << ' ' << mu;
}

TEST(SurfaceScatter, NeverReflectsMoreLightThanArrives) {
    for (const SurfaceLook& look : looks({0.9F, 0.5F, 0.0F}))
        for (const float mu : {0.02F, 0.3F, 0.9F}) {
            const Eigen::Vector3f back = furnace(look, mu);
            EXPECT_LE(back.maxCoeff(), 1.01F) << look.metallic << ' ' << look.roughness;
            EXPECT_GE(back.minCoeff(), 0) << look.metallic << ' ' << look.roughness;
        }
}

TEST(SurfaceScatter, IsReciprocal) {
    const Eigen::Vector3f a = directionAt(0.3F, 0.2F), b = directionAt(0.8F, 2.5F);
    for (const SurfaceLook& look : looks({0.8F, 0.5F, 0.1F})) {
        const Eigen::Vector3f there = SurfaceScatter(look, a).evaluate(b).value / b.z();
        const Eigen::Vector3f back = SurfaceScatter(look, b).evaluate(a).value / a.z();
        EXPECT_NEAR((there - back).norm(), 0, 1e-4F * there.norm())
            << look.metallic << ' ' << look.roughness;
    }
}

/// Share of the samples, and integral of the density, in cells of equal solid angle.
struct Cells {
    static constexpr int kSide = 8, kFine = 48;
    std::array<double, kSide * kSide> sampled{}, expected{};

    Cells(const SurfaceLook& look, float mu) {
        const SurfaceScatter scatter(look, directionAt(mu, 0.3F));
        constexpr std::uint32_t kSamples = 32768;
        for (std::uint32_t i = 0; i < kSamples; ++i) {
            const ScatterSample s = scatter.sample(PixelSampler(5, 1, i, false).pair(3));
            if (!(s.density > 0)) continue;
            const double phi = std::atan2(s.wi.y(), s.wi.x()) / (2 * M_PI) + 0.5;
            const int row = std::min(static_cast<int>(s.wi.z() * kSide), kSide - 1);
            const int column = std::min(static_cast<int>(phi * kSide), kSide - 1);
            sampled[static_cast<std::size_t>(row * kSide + column)] += 1.0 / kSamples;
        }
        constexpr int kNodes = kSide * kFine;
        for (int i = 0; i < kNodes; ++i)
            for (int j = 0; j < kNodes; ++j) {
                const auto z = static_cast<float>((i + 0.5) / kNodes);
                const auto phi = static_cast<float>(2 * M_PI * ((j + 0.5) / kNodes - 0.5));
                expected[static_cast<std::size_t>(i / kFine * kSide + j / kFine)] +=
                    scatter.evaluate(directionAt(z, phi)).density * 2 * M_PI / kNodes / kNodes;
            }
    }
};

TEST(SurfaceScatter, SamplesFollowTheirDensity) {
    for (const SurfaceLook& look : looks({0.8F, 0.5F, 0.3F}))
        for (const float mu : {0.2F, 0.9F}) {
            // Lobes of a lower roughness are too sharp for the quadrature.
            if (look.roughness < 0.3F && !look.matt) continue;
            const Cells cells(look, mu);
            for (std::size_t i = 0; i < cells.sampled.size(); ++i)
                EXPECT_NEAR(cells.sampled[i], cells.expected[i], 0.004)
                    << look.metallic << ' ' << look.roughness << ' ' << mu << " cell " << i;
        }
}

TEST(SurfaceScatter, WeightOfASampleIsReflectanceDividedByDensity) {
    const SurfaceScatter scatter({{0.9F, 0.7F, 0.2F}, 0.7F, 0.4F, false}, directionAt(0.5F, 1));
    for (std::uint32_t i = 0; i < 64; ++i) {
        const ScatterSample s = scatter.sample(PixelSampler(5, 1, i, false).pair(3));
        if (!(s.density > 0)) continue;
        const ScatterValue f = scatter.evaluate(s.wi);
        EXPECT_NEAR((f.value - s.weight * s.density).norm(), 0, 1e-4F * f.value.norm());
        EXPECT_NEAR(s.wi.norm(), 1, 1e-5F);
    }
}

TEST(SurfaceScatter, MirrorsAndGrazingViewsGiveFiniteLight) {
    for (const float roughness : {0.0F, 1.0F})
        for (const float mu : {0.0F, 1e-6F, 1.0F}) {
            const SurfaceScatter scatter({{1, 1, 1}, 1, roughness, false}, directionAt(mu, 0));
            for (std::uint32_t i = 0; i < 256; ++i) {
                const ScatterSample s = scatter.sample(PixelSampler(5, 1, i, false).pair(3));
                EXPECT_TRUE(s.weight.allFinite() && std::isfinite(s.density) && s.wi.allFinite());
            }
        }
}

}  // namespace
}  // namespace mfar
