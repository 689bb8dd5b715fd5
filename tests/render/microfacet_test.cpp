#include "pipeline/render/microfacet.h"
#include "pipeline/render/sobol.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mfar {
namespace {

Eigen::Vector3f viewAt(float mu) {
    return {std::sqrt(1 - mu * mu), 0, mu};
}

/// Integral of f(direction) over the upper hemisphere, by the midpoint rule.
template <int Phis = 256, typename F>
double overHemisphere(F f) {
    constexpr int kThetas = 256;
    double sum = 0;
    for (int i = 0; i < kThetas; ++i)
        for (int j = 0; j < Phis; ++j) {
            const double s = (i + 0.5) / kThetas;
            const double z = s * s * (3 - 2 * s), dz = 6 * s * (1 - s) / kThetas;
            const double phi = 2 * M_PI * (j + 0.5) / Phis, r = std::sqrt(1 - z * z);
            sum += dz * 2 * M_PI / Phis *
                   f(Eigen::Vector3d(r * std::cos(phi), r * std::sin(phi), z).cast<float>());
        }
    return sum;
}

TEST(Microfacet, DensityOfVisibleNormalsIntegratesToOne) {
    for (const float alpha : {0.1F, 0.4F, 1.0F})
        for (const float mu : {0.1F, 0.5F, 0.95F}) {
            const Ggx ggx(alpha);
            const Eigen::Vector3f wo = viewAt(mu);
            const double total = overHemisphere([&](const Eigen::Vector3f& h) {
                const float cosine = std::max(0.0F, wo.dot(h));
                return ggx.reflectedDensity(wo, h) * 4 * cosine;
            });
            EXPECT_NEAR(total, 1, 0.01) << alpha << ' ' << mu;
        }
}

TEST(Microfacet, MaskingTermIsTheVisibleShareOfTheNormals) {
    const Ggx ggx(0.5F);
    const Eigen::Vector3f wo = viewAt(0.4F);
    // The visible normals have the same projected area as the surface (Heitz 2014, equation 14).
    const double projected = overHemisphere([&](const Eigen::Vector3f& h) {
        return ggx.masking(0.4F) * ggx.density(h) * std::max(0.0F, wo.dot(h));
    });
    EXPECT_NEAR(projected, 0.4, 0.004);
}

TEST(Microfacet, SampledNormalsFollowTheirDensity) {
    const Ggx ggx(0.3F);
    const Eigen::Vector3f wo = viewAt(0.3F);
    Eigen::Vector3d sampled{0, 0, 0};
    constexpr int kSamples = 16384;
    for (std::uint32_t i = 0; i < kSamples; ++i)
        sampled += ggx.sampleNormal(wo, PixelSampler(0, 0, i, false).pair(0)).cast<double>();
    for (int axis = 0; axis < 3; ++axis) {
        const double expected = overHemisphere([&](const Eigen::Vector3f& h) {
            return ggx.reflectedDensity(wo, h) * 4 * std::max(0.0F, wo.dot(h)) * h[axis];
        });
        EXPECT_NEAR(sampled[axis] / kSamples, expected, 0.004) << axis;
    }
}

TEST(Microfacet, AlbedoTableMatchesTheIntegral) {
    for (const float roughness : {0.35F, 0.62F, 1.0F})
        for (const float mu : {0.08F, 0.33F, 0.9F}) {
            const Ggx ggx(alphaOf(roughness));
            const Eigen::Vector3f wo = viewAt(mu);
            const double full = overHemisphere<1024>([&](const Eigen::Vector3f& wi) {
                const Eigen::Vector3f h = (wo + wi).normalized();
                return ggx.density(h) * ggx.visibility(mu, wi.z()) * wi.z();
            });
            EXPECT_NEAR(specularAlbedo(roughness, mu).full(), full, 0.005)
                << roughness << ' ' << mu;
        }
}

TEST(Microfacet, MeanAlbedoIsTheMeanOverDirections) {
    for (const float roughness : {0.2F, 0.77F}) {
        double sum = 0;
        for (int i = 0; i < 512; ++i) {
            const float mu = (static_cast<float>(i) + 0.5F) / 512;
            sum += 2 * mu * specularAlbedo(roughness, mu).full() / 512;
        }
        EXPECT_NEAR(meanSpecularAlbedo(roughness).full(), sum, 0.003);
    }
}

}  // namespace
}  // namespace mfar
