#pragma once

#include "base/light_word.h"

#include <Eigen/Core>

namespace mfar {

/// The colours of a surface by which its light is multiplied, as of glTF's metallic-roughness
/// material; linear, shares in [0, 1].
struct Paint {
    Eigen::Vector3f baseColour{0, 0, 0};
    float metallic = 0;

    /// Of diffuse light.
    [[nodiscard]] Eigen::Vector3f diffuse() const { return (1 - metallic) * baseColour; }
    /// Of specular light: reflectance along the normal. Grazing, a surface reflects more, which is
    /// left in the light.
    [[nodiscard]] Eigen::Vector3f specular() const {
        return Eigen::Vector3f::Constant((1 - metallic) * kDielectricReflectance) +
               metallic * baseColour;
    }
};

/// What a surface sends to the eye, without its paint.
struct SurfaceLight {
    Eigen::Vector3f diffuse{0, 0, 0};   ///< radiance of the surface if it were white
    Eigen::Vector3f specular{0, 0, 0};  ///< and if it reflected all light along its normal

    [[nodiscard]] Eigen::Vector3f on(const Paint& paint) const {
        return paint.diffuse().cwiseProduct(diffuse) + paint.specular().cwiseProduct(specular);
    }
};

[[nodiscard]] inline LightWords packed(const SurfaceLight& light, float exposure) {
    const auto word = [&](const Eigen::Vector3f& rgb) {
        return packedLight({exposure * rgb.x(), exposure * rgb.y(), exposure * rgb.z()});
    };
    return {word(light.diffuse), word(light.specular)};
}

/// The light of a radiance of which `white` is the diffuse part before its paint.
[[nodiscard]] inline SurfaceLight lightOf(const Eigen::Vector3f& radiance,
                                          const Eigen::Vector3f& white, const Paint& paint) {
    // No paint is darker: a metal's channel that reflects nothing has no light.
    constexpr float kLeast = 0.01F;
    const Eigen::Vector3f rest = radiance - paint.diffuse().cwiseProduct(white);
    return {white, rest.cwiseMax(0.0F).cwiseQuotient(paint.specular().cwiseMax(kLeast))};
}

}  // namespace mfar
