#include "pipeline/render/surface_scatter.h"

#include "base/light_word.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mfar {
namespace {

constexpr float kInversePi = std::numbers::inv_pi_v<float>;
constexpr float kMostSpecular = 0.98F;
constexpr float kLeastPassed = 1e-4F;
constexpr float kLeastCosine = 1e-5F;

float fifthPower(float x) {
    const float x2 = x * x;
    return x2 * x2 * x;
}

/// A part of the light hits several microfacets, one after the other. Returns the share of this
/// part that none of them absorbs (Kulla and Conty 2017).
float manyfoldShare(float f0, const SpecularAlbedo& mean) {
    const float fresnel = f0 + (1 - f0) / 21;
    return fresnel * fresnel * mean.full() / (1 - fresnel * std::max(1 - mean.full(), 0.0F));
}

}  // namespace

SurfaceScatter::SurfaceScatter(const SurfaceLook& look, const Eigen::Vector3f& wo)
    : wo_(wo), matt_(look.matt), roughness_(look.roughness), ggx_(alphaOf(look.roughness)) {
    wo_.z() = std::max(wo_.z(), kLeastCosine);
    diffuseColour_ = look.baseColour;
    if (matt_) return;
    const SpecularAlbedo mean = meanSpecularAlbedo(roughness_);
    const float lost = std::max(1 - mean.full(), 0.0F);
    const float metallic = look.metallic;
    f0_ = Eigen::Vector3f::Constant(kDielectricReflectance * (1 - metallic)) +
          metallic * look.baseColour;
    dielectricManyfold_ = manyfoldShare(kDielectricReflectance, mean);
    Eigen::Vector3f manyfold;
    for (int c = 0; c < 3; ++c)
        manyfold[c] = (1 - metallic) * dielectricManyfold_ +
                      metallic * manyfoldShare(look.baseColour[c], mean);
    if (lost > kLeastPassed) manyfoldFactor_ = manyfold * (kInversePi / lost);
    const float passedMean =
        1 - kDielectricReflectance * mean.scale - mean.offset - dielectricManyfold_ * lost;
    diffuseColour_ *= 1 - metallic;
    whiteFactor_ = kInversePi / std::max(passedMean, kLeastPassed);
    passedOut_ = passed(wo_.z());
    const SpecularAlbedo albedo = specularAlbedo(roughness_, wo_.z());
    reflectance_ = {passedOut_.diffuse, passedOut_.manyfold * manyfold,
                    (albedo.scale * f0_).array() + albedo.offset};
    const float specular = reflectance_.mirrored.mean();
    const float wide = manyfold.mean() * passedOut_.manyfold +
                       (1 - metallic) * look.baseColour.mean() * passedOut_.diffuse;
    // A few samples of the mirrored lobe would be distributed unevenly. So if its peak is lower
    // than the broad lobes, fewer samples are drawn from it and more from the broad lobes, which
    // include the mirrored directions.
    const float height = fresnel(wo_.z()).mean() / (4 * alphaOf(roughness_) * alphaOf(roughness_));
    specularShare_ =
        std::min(specular / (specular + wide) * std::min(1.0F, height / wide), kMostSpecular);
}

Eigen::Vector3f SurfaceScatter::fresnel(float cosH) const {
    const float bent = fifthPower(1 - std::clamp(cosH, 0.0F, 1.0F));
    return f0_ + bent * (Eigen::Vector3f::Ones() - f0_);
}

SurfaceScatter::Passed SurfaceScatter::passed(float mu) const {
    const SpecularAlbedo albedo = specularAlbedo(roughness_, mu);
    const float lost = std::max(1 - albedo.full(), 0.0F);
    const float back =
        kDielectricReflectance * albedo.scale + albedo.offset + dielectricManyfold_ * lost;
    return {std::max(1 - back, 0.0F), lost};
}

ScatterValue SurfaceScatter::evaluate(const Eigen::Vector3f& wi, Lobes lobes) const {
    if (!(wi.z() > kLeastCosine)) return {};
    const float mu = wi.z();
    const float even = kInversePi * mu;
    if (matt_) return {diffuseColour_ * even, even, even};
    ScatterValue out;
    out.density = even;
    if (lobes != Lobes::Mirrored) {
        const Passed in = passed(mu);
        out.white = whiteFactor_ * (mu * in.diffuse * passedOut_.diffuse);
        out.value =
            diffuseColour_ * out.white + manyfoldFactor_ * (mu * in.manyfold * passedOut_.manyfold);
        if (lobes == Lobes::Broad) return out;
    }
    const Eigen::Vector3f h = (wo_ + wi).normalized();
    const float density = ggx_.density(h);
    out.value += fresnel(wo_.dot(h)) * (density * ggx_.visibility(wo_.z(), wi.z()) * wi.z());
    const float mirrored = density * ggx_.masking(wo_.z()) / (4 * wo_.z());
    out.density += shareOf(lobes) * (mirrored - out.density);
    return out;
}

float SurfaceScatter::shareOf(Lobes lobes) const {
    if (matt_ || lobes == Lobes::Broad) return 0;
    return lobes == Lobes::Mirrored ? 1 : specularShare_;
}

ScatterSample SurfaceScatter::sample(const Eigen::Vector2f& u, Lobes lobes) const {
    ScatterSample out;
    const float share = shareOf(lobes);
    if (u.x() >= share) {
        const float x = (u.x() - share) / (1 - share);
        out.wi = cosineDirection({std::min(x, 1 - 0x1p-24F), u.y()});
    } else {
        const Eigen::Vector3f h = ggx_.sampleNormal(wo_, {u.x() / share, u.y()});
        out.wi = (2 * wo_.dot(h) * h - wo_).normalized();
    }
    const ScatterValue f = evaluate(out.wi, lobes);
    if (!(f.density > 0)) return out;
    out.density = f.density;
    out.weight = f.value / f.density;
    out.white = f.white / f.density;
    return out;
}

Eigen::Vector2f discPoint(const Eigen::Vector2f& u) {
    const float x = 2 * u.x() - 1, y = 2 * u.y() - 1;
    if (x == 0 && y == 0) return {0, 0};
    constexpr float kQuarter = std::numbers::pi_v<float> / 4;
    if (std::abs(x) > std::abs(y)) {
        const float phi = kQuarter * (y / x);
        return {x * std::cos(phi), x * std::sin(phi)};
    }
    const float phi = kQuarter * (x / y);
    return {y * std::sin(phi), y * std::cos(phi)};
}

Eigen::Vector3f cosineDirection(const Eigen::Vector2f& u) {
    const float phi = 2 * std::numbers::pi_v<float> * u.x(), r = std::sqrt(u.y());
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u.y())};
}

}  // namespace mfar
