#include "pipeline/render/microfacet.h"

#include "pipeline/render/sobol.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace mfar {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kLeastAlpha = 1e-3F;
constexpr int kAngles = 32, kRoughnesses = 32;
constexpr std::uint32_t kAlbedoSamples = 256;

/// Tables over roughness and sqrt(mu), where mu is the cosine of the direction to the normal. The
/// square root puts more nodes at small mu, where the albedo changes fast.
struct AlbedoTables {
    std::array<std::array<SpecularAlbedo, kAngles>, kRoughnesses> at;
    std::array<SpecularAlbedo, kRoughnesses> mean;

    AlbedoTables();
};

SpecularAlbedo albedoBySampling(float roughness, float mu) {
    const Ggx ggx(alphaOf(roughness));
    const Eigen::Vector3f wo{std::sqrt(std::max(0.0F, 1 - mu * mu)), 0, mu};
    SpecularAlbedo sum{0, 0};
    for (std::uint32_t i = 0; i < kAlbedoSamples; ++i) {
        const auto [x, y] = sobolReversed(i);
        const Eigen::Vector2f u{(static_cast<float>(i) + 0.5F) / kAlbedoSamples,
                                static_cast<float>(reversedBits(x) >> 8) * 0x1p-24F +
                                    0.5F / kAlbedoSamples};
        const Eigen::Vector3f h = ggx.sampleNormal(wo, u);
        const float cosH = wo.dot(h), cosI = 2 * cosH * h.z() - wo.z();
        if (!(cosI > 0) || !(cosH > 0)) continue;
        const float weight = ggx.visibility(mu, cosI) * 4 * mu * cosI / ggx.masking(mu);
        const float bent = std::pow(1 - std::min(cosH, 1.0F), 5.0F);
        sum.scale += weight * (1 - bent);
        sum.offset += weight * bent;
    }
    return {sum.scale / kAlbedoSamples, sum.offset / kAlbedoSamples};
}

AlbedoTables::AlbedoTables() {
    for (int r = 0; r < kRoughnesses; ++r) {
        const float roughness = static_cast<float>(r) / (kRoughnesses - 1);
        SpecularAlbedo sum{0, 0};
        float weights = 0;
        for (int a = 0; a < kAngles; ++a) {
            const float root = static_cast<float>(a) / (kAngles - 1);
            const float mu = std::max(root * root, 1e-4F);
            at[r][a] = albedoBySampling(roughness, mu);
            // Trapezoidal rule over root = sqrt(mu). The mean's weight 2 mu dmu is 4 root^3 droot.
            const float weight = root * root * root * (a + 1 == kAngles ? 0.5F : 1.0F);
            sum.scale += weight * at[r][a].scale;
            sum.offset += weight * at[r][a].offset;
            weights += weight;
        }
        mean[r] = {sum.scale / weights, sum.offset / weights};
    }
}

const AlbedoTables& albedoTables() {
    static const AlbedoTables tables;
    return tables;
}

struct Place {
    std::size_t index;
    float rest;
};

Place placeIn(int nodes, float share) {
    const float x = std::clamp(share, 0.0F, 1.0F) * static_cast<float>(nodes - 1);
    const int i = std::min(static_cast<int>(x), nodes - 2);
    return {static_cast<std::size_t>(i), x - static_cast<float>(i)};
}

SpecularAlbedo between(const SpecularAlbedo& a, const SpecularAlbedo& b, float share) {
    return {a.scale + share * (b.scale - a.scale), a.offset + share * (b.offset - a.offset)};
}

}  // namespace

float Ggx::density(const Eigen::Vector3f& h) const {
    // x^2 + y^2 is more exact than 1 - z^2, which loses its digits at the peak of a narrow lobe.
    const float slope = (h.x() * h.x() + h.y() * h.y()) / alpha2_ + h.z() * h.z();
    return 1 / (kPi * alpha2_ * slope * slope);
}

float Ggx::visibility(float cosO, float cosI) const {
    const float o = cosI * std::sqrt(alpha2_ + (1 - alpha2_) * cosO * cosO);
    const float i = cosO * std::sqrt(alpha2_ + (1 - alpha2_) * cosI * cosI);
    return 0.5F / (o + i);
}

float Ggx::masking(float mu) const {
    return 2 * mu / (mu + std::sqrt(alpha2_ + (1 - alpha2_) * mu * mu));
}

Eigen::Vector3f Ggx::sampleNormal(const Eigen::Vector3f& wo, const Eigen::Vector2f& u) const {
    const Eigen::Vector3f w =
        Eigen::Vector3f(wo.x() * alpha_, wo.y() * alpha_, wo.z()).normalized();
    const float phi = 2 * kPi * u.x();
    const float z = (1 - u.y()) * (1 + w.z()) - w.z();
    const float r = std::sqrt(std::clamp(1 - z * z, 0.0F, 1.0F));
    const Eigen::Vector3f sum{r * std::cos(phi) + w.x(), r * std::sin(phi) + w.y(), z + w.z()};
    return Eigen::Vector3f(sum.x() * alpha_, sum.y() * alpha_, std::max(sum.z(), 1e-7F))
        .normalized();
}

float alphaOf(float roughness) {
    return std::max(roughness * roughness, kLeastAlpha);
}

SpecularAlbedo specularAlbedo(float roughness, float mu) {
    const AlbedoTables& tables = albedoTables();
    const auto [r, s] = placeIn(kRoughnesses, roughness);
    const auto [a, t] = placeIn(kAngles, std::sqrt(std::max(mu, 0.0F)));
    return between(between(tables.at[r][a], tables.at[r][a + 1], t),
                   between(tables.at[r + 1][a], tables.at[r + 1][a + 1], t), s);
}

SpecularAlbedo meanSpecularAlbedo(float roughness) {
    const auto [r, s] = placeIn(kRoughnesses, roughness);
    return between(albedoTables().mean[r], albedoTables().mean[r + 1], s);
}

}  // namespace mfar
