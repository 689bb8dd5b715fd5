#pragma once

#include <Eigen/Core>

namespace mfar {

/// Isotropic GGX (Trowbridge-Reitz) microfacets of width alpha in (0, 1] with Smith's
/// height-correlated masking (Heitz 2014). Directions have unit length, with z along the surface
/// normal.
class Ggx {
public:
    explicit Ggx(float alpha) : alpha_(alpha), alpha2_(alpha * alpha) {}

    /// Density D(h) of microfacet normals [1/sr].
    [[nodiscard]] float density(const Eigen::Vector3f& h) const;
    /// Visibility term G2 / (4 cos_o cos_i).
    [[nodiscard]] float visibility(float cosO, float cosI) const;
    /// Masking term G1: the share of microfacets that is visible from a direction. mu > 0 is the
    /// cosine of the direction's angle from the normal.
    [[nodiscard]] float masking(float mu) const;
    /// Samples a microfacet normal among those visible from `wo`; wo.z > 0 (Dupuy and Benyoub
    /// 2023).
    [[nodiscard]] Eigen::Vector3f sampleNormal(const Eigen::Vector3f& wo,
                                               const Eigen::Vector2f& u) const;
    /// Probability density [1/sr] of the direction into which `h`, a normal from sampleNormal(),
    /// reflects `wo`.
    [[nodiscard]] float reflectedDensity(const Eigen::Vector3f& wo,
                                         const Eigen::Vector3f& h) const {
        return masking(wo.z()) * density(h) / (4 * wo.z());
    }

private:
    float alpha_, alpha2_;
};

/// Share of light that GGX of one roughness reflects after a single bounce. It is f0 * scale +
/// offset for Schlick's Fresnel term with reflectance f0 at normal incidence (Karis 2013).
struct SpecularAlbedo {
    float scale = 1, offset = 0;

    /// Share for a Fresnel term of 1.
    [[nodiscard]] float full() const { return scale + offset; }
};

/// GGX's alpha for a perceptual roughness in [0, 1]. It is slightly above 0 even for a mirror.
[[nodiscard]] float alphaOf(float roughness);

/// specularAlbedo() is the reflected share of light for one direction; mu is the cosine of the
/// direction's angle from the normal. meanSpecularAlbedo() is the cosine-weighted mean of this
/// share over all directions. Both functions read tables that the first call computes; the error is
/// below 0.01.
[[nodiscard]] SpecularAlbedo specularAlbedo(float roughness, float mu);
[[nodiscard]] SpecularAlbedo meanSpecularAlbedo(float roughness);

}  // namespace mfar
