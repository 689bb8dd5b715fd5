#pragma once

#include "pipeline/render/microfacet.h"

#include <Eigen/Core>

namespace mfar {

/// How a surface looks at a point; shares in [0, 1].
struct SurfaceLook {
    Eigen::Vector3f baseColour{1, 1, 1};
    float metallic = 0, roughness = 1;
    bool matt = false;  ///< nothing but Lambert's law
};

struct ScatterValue {
    Eigen::Vector3f value{0, 0, 0};  ///< reflectance distribution times cosine of wi [1/sr]
    float white = 0;                 ///< its diffuse part, divided by Paint::diffuse() [1/sr]
    float density = 0;               ///< of SurfaceScatter::sample() [1/sr]
};

struct ScatterSample {
    Eigen::Vector3f wi{0, 0, 1};
    Eigen::Vector3f weight{0, 0, 0};  ///< value / density
    float white = 0;                  ///< the value's / density
    float density = 0;                ///< 0: nothing goes anywhere
};

/// The parts of a reflection: what is scattered widely, and the lobe about the mirrored direction.
enum class Lobes { Both, Broad, Mirrored };

/// Shares of light that a surface sends to the eye: of even light over the hemisphere, and of that
/// in the mirrored lobe.
struct Reflectance {
    float white = 1;                    ///< of even light, before the diffuse paint
    Eigen::Vector3f manyfold{0, 0, 0};  ///< of even light, by several reflections
    Eigen::Vector3f mirrored{0, 0, 0};
};

/// Reflection of glTF's metallic-roughness material seen from one direction: GGX with Schlick's
/// Fresnel term, what leaves it after several reflections (Kulla and Conty 2017), and Lambert's law
/// for the light that passes a dielectric both ways; dielectric and metal mixed by `metallic`.
/// Reciprocal, and reflects all light if the base colour is white. Directions of unit length, z
/// along the normal, above it.
class SurfaceScatter {
public:
    SurfaceScatter(const SurfaceLook& look, const Eigen::Vector3f& wo);

    /// The density is that of samples of these lobes.
    [[nodiscard]] ScatterValue evaluate(const Eigen::Vector3f& wi, Lobes lobes = Lobes::Both) const;
    [[nodiscard]] ScatterSample sample(const Eigen::Vector2f& u, Lobes lobes = Lobes::Both) const;
    [[nodiscard]] const Reflectance& reflectance() const { return reflectance_; }
    /// Of light in any colour; the paint of white().
    [[nodiscard]] const Eigen::Vector3f& diffuseColour() const { return diffuseColour_; }

private:
    /// What a first reflection at cosine mu leaves to the broad lobes.
    struct Passed {
        float diffuse = 1;   ///< share that goes through a dielectric's surface
        float manyfold = 0;  ///< share that hits the surface again
    };
    [[nodiscard]] Passed passed(float mu) const;
    [[nodiscard]] Eigen::Vector3f fresnel(float cosH) const;
    /// Of the samples, that go into the mirrored lobe.
    [[nodiscard]] float shareOf(Lobes lobes) const;

    Eigen::Vector3f wo_;
    bool matt_;
    float roughness_;
    Ggx ggx_;
    Eigen::Vector3f f0_{0, 0, 0};
    Eigen::Vector3f manyfoldFactor_{0, 0, 0}, diffuseColour_{0, 0, 0};
    float whiteFactor_ = 0;
    float dielectricManyfold_ = 0;  // share that a dielectric sends back of what hits it again
    Passed passedOut_;
    Reflectance reflectance_;
    float specularShare_ = 0;  // of the samples
};

/// Into the hemisphere about z, density cosine / pi. The first number is the azimuth, the second
/// alone gives the cosine, on which most depends: the sequence is at its best with such a product.
[[nodiscard]] Eigen::Vector3f cosineDirection(const Eigen::Vector2f& u);
/// Into the unit disc, area-preserving (Shirley and Chiu 1997).
[[nodiscard]] Eigen::Vector2f discPoint(const Eigen::Vector2f& u);

}  // namespace mfar
