#pragma once

#include "pipeline/render/microfacet.h"

#include <Eigen/Core>

namespace mfar {

/// Appearance of a surface at a point. All values are in [0, 1].
struct SurfaceLook {
    Eigen::Vector3f baseColour{1, 1, 1};
    float metallic = 0, roughness = 1;
    bool matt = false;  ///< true if the surface reflects only by Lambert's law
};

struct ScatterValue {
    Eigen::Vector3f value{0, 0, 0};  ///< BRDF times the cosine of wi [1/sr]
    float white = 0;                 ///< diffuse part of `value` / diffuse paint [1/sr]
    float density = 0;               ///< probability density of wi [1/sr]
};

struct ScatterSample {
    Eigen::Vector3f wi{0, 0, 1};
    Eigen::Vector3f weight{0, 0, 0};  ///< ScatterValue::value / density
    float white = 0;                  ///< diffuse part of `weight` divided by the diffuse paint
    float density = 0;  ///< probability density of wi [1/sr]; 0: the sample scatters no light
};

/// Parts of a reflection. `Mirrored` is the lobe around the mirrored direction; `Broad` is all
/// other reflection.
enum class Lobes { Both, Broad, Mirrored };

/// Shares of light that a surface sends to the eye. `mirrored` is for light in the mirrored lobe;
/// `white` and `manyfold` are for uniform light from the hemisphere.
struct Reflectance {
    float white = 1;  ///< share that is reflected diffusely, if the diffuse paint is white
    /// Share of the light that is reflected by several microfacets, one after the other.
    Eigen::Vector3f manyfold{0, 0, 0};
    Eigen::Vector3f mirrored{0, 0, 0};
};

/// Reflection of glTF's metallic-roughness material, seen from one direction. It has three parts:
/// GGX with Schlick's Fresnel term, multiple reflection between microfacets (Kulla and Conty 2017),
/// and Lambert's law for light that enters and leaves a dielectric. The model is reciprocal, and
/// reflects all light if the base colour is white. Directions have unit length and are above the
/// surface. z is the normal.
class SurfaceScatter {
public:
    SurfaceScatter(const SurfaceLook& look, const Eigen::Vector3f& wo);

    [[nodiscard]] ScatterValue evaluate(const Eigen::Vector3f& wi, Lobes lobes = Lobes::Both) const;
    [[nodiscard]] ScatterSample sample(const Eigen::Vector2f& u, Lobes lobes = Lobes::Both) const;
    [[nodiscard]] const Reflectance& reflectance() const { return reflectance_; }
    /// The paint by which `white` must be multiplied to give the diffuse part.
    [[nodiscard]] const Eigen::Vector3f& diffuseColour() const { return diffuseColour_; }

private:
    /// Shares of light that the first reflection leaves for the broad lobes. `mu` is the
    /// direction's cosine to the normal.
    struct Passed {
        float diffuse = 1;   ///< share that enters a dielectric
        float manyfold = 0;  ///< share that hits another microfacet
    };
    [[nodiscard]] Passed passed(float mu) const;
    [[nodiscard]] Eigen::Vector3f fresnel(float cosH) const;
    [[nodiscard]] float shareOf(Lobes lobes) const;

    Eigen::Vector3f wo_;
    bool matt_;
    float roughness_;
    Ggx ggx_;
    Eigen::Vector3f f0_{0, 0, 0};
    Eigen::Vector3f manyfoldFactor_{0, 0, 0}, diffuseColour_{0, 0, 0};
    float whiteFactor_ = 0;
    float dielectricManyfold_ = 0;
    Passed passedOut_;
    Reflectance reflectance_;
    float specularShare_ = 0;
};

/// Maps two random numbers to the hemisphere about z with density cosine / pi. The first number
/// gives the azimuth, the second the cosine. This separation makes the Sobol sequence most
/// effective.
[[nodiscard]] Eigen::Vector3f cosineDirection(const Eigen::Vector2f& u);
/// Maps two random numbers to the unit disc and preserves area (Shirley and Chiu 1997).
[[nodiscard]] Eigen::Vector2f discPoint(const Eigen::Vector2f& u);

}  // namespace mfar
