#pragma once

#include <Eigen/Core>

namespace mfar {

/// Isotropic GGX (Trowbridge-Reitz) microfacets of width alpha in (0, 1], with Smith's
/// height-correlated masking (Heitz 2014). Directions have unit length, and z is the surface
/// normal.
class Ggx {
public:
    explicit Ggx(float alpha) : alpha_(alpha), alpha2_(alpha * alpha) {}

    /// Density D(h) of microfacet normals [1/sr].
    [[nodiscard]] float density(const Eigen::Vector3f& h) const;
    [[nodiscard]] float visibility(float cosO, float cosI) const;
    /// Share of microfacets visible from a direction. `mu` > 0 is the direction's cosine to the
    /// normal.
    [[nodiscard]] float masking(float mu) const;
    /// Samples one of the microfacet normals visible from `wo`, where wo.z > 0 (Dupuy and Benyoub
    /// 2023).
    [[nodiscard]] Eigen::Vector3f sampleNormal(const Eigen::Vector3f& wo,
                                               const Eigen::Vector2f& u) const;
    /// Probability density [1/sr] of the direction of `wo` reflected at `h`. `h` must come from
    /// sampleNormal().
    [[nodiscard]] float reflectedDensity(const Eigen::Vector3f& wo,
                                         const Eigen::Vector3f& h) const {
        return masking(wo.z()) * density(h) / (4 * wo.z());
    }

private:
    float alpha_, alpha2_;
};

/// Share of light that GGX reflects in a single bounce. It is f0 * scale + offset for Schlick's
/// Fresnel term with reflectance f0 at normal incidence (Karis 2013).
struct SpecularAlbedo {
    float scale = 1, offset = 0;

    [[nodiscard]] float full() const { return scale + offset; }
};

/// Returns GGX's alpha for a perceptual roughness in [0, 1]. The result is slightly above 0 even
/// for a mirror.
[[nodiscard]] float alphaOf(float roughness);

/// specularAlbedo() returns the reflected share of light for a direction with cosine `mu` to the
/// normal. meanSpecularAlbedo() returns its cosine-weighted mean over all directions. Both
/// functions read tables that the first call computes. The error is below 0.01.
[[nodiscard]] SpecularAlbedo specularAlbedo(float roughness, float mu);
[[nodiscard]] SpecularAlbedo meanSpecularAlbedo(float roughness);

}  // namespace mfar
