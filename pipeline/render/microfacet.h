#pragma once

#include <Eigen/Core>

namespace mfar {

/// Isotropic GGX (Trowbridge-Reitz) microfacets of width alpha in (0, 1] with Smith's
/// height-correlated masking (Heitz 2014). Directions are of unit length with z along the normal.
class Ggx {
public:
    explicit Ggx(float alpha) : alpha_(alpha), alpha2_(alpha * alpha) {}

    /// Density of normals D(h) [1/sr].
    [[nodiscard]] float density(const Eigen::Vector3f& h) const;
    /// G2 / (4 cos_o cos_i).
    [[nodiscard]] float visibility(float cosO, float cosI) const;
    /// G1(w): the visible share seen from cosine mu > 0.
    [[nodiscard]] float masking(float mu) const;
    /// A normal among those visible from `wo`, wo.z > 0 (Dupuy and Benyoub 2023).
    [[nodiscard]] Eigen::Vector3f sampleNormal(const Eigen::Vector3f& wo,
                                               const Eigen::Vector2f& u) const;
    /// Density of reflecting wo to wi by a normal of sampleNormal() [1/sr].
    [[nodiscard]] float reflectedDensity(const Eigen::Vector3f& wo,
                                         const Eigen::Vector3f& h) const {
        return masking(wo.z()) * density(h) / (4 * wo.z());
    }

private:
    float alpha_, alpha2_;
};

/// Share of light that GGX of this roughness reflects once, with Schlick's Fresnel term of
/// reflectance f0 at normal incidence: f0 * scale + offset (Karis 2013); and its cosine-weighted
/// mean over directions.
struct SpecularAlbedo {
    float scale = 1, offset = 0;

    /// For a Fresnel term of 1.
    [[nodiscard]] float full() const { return scale + offset; }
};

/// GGX's alpha for a perceptual roughness in [0, 1]; slightly above 0 even for a mirror.
[[nodiscard]] float alphaOf(float roughness);

/// From tables that the first call computes; error below 0.01.
[[nodiscard]] SpecularAlbedo specularAlbedo(float roughness, float mu);
[[nodiscard]] SpecularAlbedo meanSpecularAlbedo(float roughness);

}  // namespace mfar
