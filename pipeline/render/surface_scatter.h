#pragma once

#include "pipeline/render/microfacet.h"

#include <Eigen/Core>

namespace mfar {

/// Appearance of a surface at a point. All numbers are in [0, 1].
struct SurfaceLook {
    Eigen::Vector3f baseColour{1, 1, 1};
    float metallic = 0, roughness = 1;
    bool matt = false;  ///< whether it reflects only by Lambert's law
};

struct ScatterValue {
    Eigen::Vector3f value{0, 0, 0};  ///< BRDF times the cosine of wi [1/sr]
    float white = 0;                 ///< diffuse part of `value` divided by the diffuse paint
                                     ///< [1/sr]
    float density = 0;               ///< probability density of wi in sample() [1/sr]
};

struct ScatterSample {
    Eigen::Vector3f wi{0, 0, 1};
    Eigen::Vector3f weight{0, 0, 0};  ///< value / density
    float white = 0;                  ///< diffuse part of `weight` divided by the diffuse paint
    float density = 0;  ///< probability density of wi [1/sr]; 0: the sample scatters no light
};

/// The parts of a reflection: broad scattering, and the lobe around the mirrored direction.
enum class Lobes { Both, Broad, Mirrored };

/// Shares of light that a surface sends to the eye, for uniform light from the hemisphere and for
/// light in the mirrored lobe.
struct Reflectance {
    float white = 1;  ///< share of uniform light that white paint scatters
    /// Share of uniform light that is reflected by several microfacets, one after the other.
    Eigen::Vector3f manyfold{0, 0, 0};
    Eigen::Vector3f mirrored{0, 0, 0};
};

/// Reflection of glTF's metallic-roughness material seen from one direction. It has three parts:
/// GGX with Schlick's Fresnel term, light that is reflected by several microfacets (Kulla and Conty
/// 2017), and Lambert's law for light that enters and leaves a dielectric. `metallic` mixes
/// dielectric and metal.
/// The reflection is reciprocal, and reflects all light if the base colour is white. Directions
/// have unit length, z is the normal, and both directions are above the surface.
class SurfaceScatter {
public:
    SurfaceScatter(const SurfaceLook& look, const Eigen::Vector3f& wo);

    /// The returned density is that of sample() with the same lobes.
    [[nodiscard]] ScatterValue evaluate(const Eigen::Vector3f& wi, Lobes lobes = Lobes::Both) const;
    [[nodiscard]] ScatterSample sample(const Eigen::Vector2f& u, Lobes lobes = Lobes::Both) const;
    [[nodiscard]] const Reflectance& reflectance() const { return reflectance_; }
    /// The paint with which the diffuse part (`white`) is multiplied.
    [[nodiscard]] const Eigen::Vector3f& diffuseColour() const { return diffuseColour_; }

private:
    /// Light that the first reflection, at cosine mu, leaves for the broad lobes.
    struct Passed {
        float diffuse = 1;   ///< share that passes the surface of a dielectric
        float manyfold = 0;  ///< share that hits another microfacet
    };
    [[nodiscard]] Passed passed(float mu) const;
    [[nodiscard]] Eigen::Vector3f fresnel(float cosH) const;
    /// Share of the samples that sample() takes from the mirrored lobe.
    [[nodiscard]] float shareOf(Lobes lobes) const;

    Eigen::Vector3f wo_;
    bool matt_;
    float roughness_;
    Ggx ggx_;
    Eigen::Vector3f f0_{0, 0, 0};
    Eigen::Vector3f manyfoldFactor_{0, 0, 0}, diffuseColour_{0, 0, 0};
    float whiteFactor_ = 0;
    // Light that hits several microfacets of a dielectric: the share of it that finally leaves the
    // surface.
    float dielectricManyfold_ = 0;
    Passed passedOut_;
    Reflectance reflectance_;
    float specularShare_ = 0;  // share of the samples for the mirrored lobe
};

/// Maps two random numbers to the hemisphere about z with density cosine / pi. The first number
/// gives the azimuth. The second alone gives the cosine, which affects the result most. The Sobol
/// sequence is most effective if the two have separate effects.
[[nodiscard]] Eigen::Vector3f cosineDirection(const Eigen::Vector2f& u);
/// Maps two random numbers to the unit disc and preserves area (Shirley and Chiu 1997).
[[nodiscard]] Eigen::Vector2f discPoint(const Eigen::Vector2f& u);

}  // namespace mfar
