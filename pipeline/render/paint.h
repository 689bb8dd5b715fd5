#pragma once

#include "base/light_word.h"
#include "pipeline/render/microfacet.h"

#include <Eigen/Core>

#include <array>

namespace mfar {

/// Lower limit of the divisor when specular light is divided by its paint. A metal may have a
/// channel that reflects nothing, from which the light on the metal cannot be computed.
inline constexpr float kLeastPaint = 0.01F;

/// The linear colours, in [0, 1], with which a surface multiplies light, as in glTF's
/// metallic-roughness material.
struct Paint {
    Eigen::Vector3f diffuse{0, 0, 0};  ///< colour for diffuse light
    Eigen::Vector3f facing{0, 0, 0};   ///< reflectance along the normal, for specular light
    SpecularAlbedo albedo{};           ///< for specular light towards the eye

    /// Paint for specular light.
    [[nodiscard]] Eigen::Vector3f specular() const {
        return (albedo.scale * facing).array() + albedo.offset;
    }
};

[[nodiscard]] inline Paint paintOf(const Eigen::Vector3f& baseColour, float metallic,
                                   const SpecularAlbedo& albedo) {
    return {(1 - metallic) * baseColour,
            Eigen::Vector3f::Constant((1 - metallic) * kDielectricReflectance) +
                metallic * baseColour,
            albedo};
}

/// Light that a surface sends to the eye, divided by the surface's paint.
struct SurfaceLight {
    Eigen::Vector3f diffuse{0, 0, 0};   ///< radiance of the surface if it were white
    Eigen::Vector3f specular{0, 0, 0};  ///< radiance if it reflected all light

    [[nodiscard]] Eigen::Vector3f on(const Paint& paint) const {
        return paint.diffuse.cwiseProduct(diffuse) + paint.specular().cwiseProduct(specular);
    }
};

/// Product of each colour channel. It is used for light that is stored as a multiple of other
/// light.
[[nodiscard]] inline SurfaceLight product(const SurfaceLight& a, const SurfaceLight& b) {
    return {a.diffuse.cwiseProduct(b.diffuse), a.specular.cwiseProduct(b.specular)};
}

/// Packs the light of a surface, multiplied by `exposure`. The reader of the words knows only
/// Paint::diffuse and Paint::facing. So the words also contain the paint's albedo towards the eye.
[[nodiscard]] inline LightWords packed(const SurfaceLight& light, const Paint& paint,
                                       float exposure) {
    const float full = paint.albedo.full();
    const auto words = [&](const Eigen::Vector3f& rgb) {
        return std::array<float, 3>{exposure * rgb.x(), exposure * rgb.y(), exposure * rgb.z()};
    };
    return packedWords({words(light.diffuse), words(full * light.specular),
                        full > 0 ? paint.albedo.offset / full : 0});
}

/// Splits `radiance` into diffuse and specular light, both divided by the paint. `white` is the
/// diffuse light, already divided by the paint.
[[nodiscard]] inline SurfaceLight lightOf(const Eigen::Vector3f& radiance,
                                          const Eigen::Vector3f& white, const Paint& paint) {
    const Eigen::Vector3f rest = radiance - paint.diffuse.cwiseProduct(white);
    return {white, rest.cwiseMax(0.0F).cwiseQuotient(paint.specular().cwiseMax(kLeastPaint))};
}

}  // namespace mfar
