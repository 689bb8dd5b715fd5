#pragma once

#include "pipeline/render/microfacet.h"

#include <Eigen/Core>

namespace mfar {

/// Appearance of a surface at a point; shares in [0, 1].
struct SurfaceLook {
    Eigen::Vector3f baseColour{1, 1, 1};
    float metallic = 0, roughness = 1;
    bool matt = false;  ///< only Lambert's law
};

struct ScatterValue {
    Eigen::Vector3f value{0, 0, 0};  ///< BRDF times cosine of wi [1/sr]
    float white = 0;                 ///< diffuse part of `value`, divided by Paint::diffuse()
                                     ///< [1/sr]
    float density = 0;               ///< of SurfaceScatter::sample() [1/sr]
};

struct ScatterSample {
    Eigen::Vector3f wi{0, 0, 1};
    Eigen::Vector3f weight{0, 0, 0};  ///< value / density
    float white = 0;                  ///< diffuse part of `weight`, without the paint
    float density = 0;                ///< 0: no light is scattered
};

/// The parts of a reflection: broad scatter, and the lobe about the mirrored direction.
enum class Lobes { Both, Broad, Mirrored };

/// Shares of light that a surface sends to the eye: for uniform light over the hemisphere, and for
/// the light in the mirrored lobe.
struct Reflectance {
    float white = 1;                    ///< of uniform light, before the diffuse paint
    Eigen::Vector3f manyfold{0, 0, 0};  ///< of uniform light, after several reflections
    Eigen::Vector3f mirrored{0, 0, 0};
};

/// Reflection of glTF's metallic-roughness material seen from one direction: GGX with Schlick's
/// Fresnel term, light after several reflections (Kulla and Conty 2017), and Lambert's law for the
/// light that passes a dielectric both ways; `metallic` mixes dielectric and metal. Reciprocal;
/// reflects all light if the base colour is white. Directions are of unit length, with z along the
/// normal, above it.
class SurfaceScatter {
public:
    SurfaceScatter(const SurfaceLook& look, const Eigen::Vector3f& wo);

    /// The density is that of sample() with these lobes.
    [[nodiscard]] ScatterValue evaluate(const Eigen::Vector3f& wi, Lobes lobes = Lobes::Both) const;
    [[nodiscard]] ScatterSample sample(const Eigen::Vector2f& u, Lobes lobes = Lobes::Both) const;
    [[nodiscard]] const Reflectance& reflectance() const { return reflectance_; }
    /// Paint by which the diffuse part (`white`) is multiplied.
    [[nodiscard]] const Eigen::Vector3f& diffuseColour() const { return diffuseColour_; }

private:
    /// Light that the first reflection at cosine mu leaves for the broad lobes.
    struct Passed {
        float diffuse = 1;   ///< share that passes a dielectric's surface
        float manyfold = 0;  ///< share that hits the surface again
    };
    [[nodiscard]] Passed passed(float mu) const;
    [[nodiscard]] Eigen::Vector3f fresnel(float cosH) const;
    /// Share of the samples that go into the mirrored lobe.
    [[nodiscard]] float shareOf(Lobes lobes) const;

    Eigen::Vector3f wo_;
    bool matt_;
    float roughness_;
    Ggx ggx_;
    Eigen::Vector3f f0_{0, 0, 0};
    Eigen::Vector3f manyfoldFactor_{0, 0, 0}, diffuseColour_{0, 0, 0};
    float whiteFactor_ = 0;
    // A dielectric returns this share of the light that hits it again.
    float dielectricManyfold_ = 0;
    Passed passedOut_;
    Reflectance reflectance_;
    float specularShare_ = 0;  // share of the samples
};

/// Maps to the hemisphere about z with density cosine / pi. The first number is the azimuth; the
/// second alone gives the cosine, on which most depends: with such a product the sequence is most
/// effective.
[[nodiscard]] Eigen::Vector3f cosineDirection(const Eigen::Vector2f& u);
/// Maps to the unit disc, area-preserving (Shirley and Chiu 1997).
[[nodiscard]] Eigen::Vector2f discPoint(const Eigen::Vector2f& u);

}  // namespace mfar
