#pragma once

#include "base/light_word.h"
#include "base/luminance.h"
#include "pipeline/render/microfacet.h"

#include <Eigen/Core>

#include <array>

namespace mfar {

/// Lower limit of the divisor when specular light is divided by its paint. A metal may reflect
/// nothing in one colour channel.
inline constexpr float kLeastPaint = 0.01F;

/// Lower limit of Paint::facing on materials that emit light. Emitted light is stored as specular
/// light, divided by the paint; a black metal's paint would be too small for it.
inline constexpr float kLeastFacingOfLamps = 0.03F;

/// Linear colours in [0, 1] by which a surface multiplies light. They follow glTF's
/// metallic-roughness material.
struct Paint {
    Eigen::Vector3f diffuse{0, 0, 0};
    Eigen::Vector3f facing{0, 0, 0};  ///< specular reflectance at normal incidence
    SpecularAlbedo albedo{};          ///< albedo of specular reflection towards the eye

    [[nodiscard]] Eigen::Vector3f specular() const {
        return (albedo.scale * facing).array() + albedo.offset;
    }
};

/// `emits`: true if the material emits light.
[[nodiscard]] inline Paint paintOf(const Eigen::Vector3f& baseColour, float metallic,
                                   const SpecularAlbedo& albedo, bool emits = false) {
    const Eigen::Vector3f facing =
        Eigen::Vector3f::Constant((1 - metallic) * kDielectricReflectance) + metallic * baseColour;
    return {(1 - metallic) * baseColour,
            emits ? Eigen::Vector3f(facing.cwiseMax(kLeastFacingOfLamps)) : facing, albedo};
}

/// Weights of a point when the light of several points of a pixel is averaged. A weight is the
/// luminance of the point's paint plus a small constant, so it is above 0.
struct PaintWeights {
    float diffuse, specular;
};
[[nodiscard]] inline PaintWeights weightsOf(const Paint& paint) {
    constexpr float kLeast = 1e-3F;
    return {kLeast + luminanceOf<float>(paint.diffuse),
            kLeast + luminanceOf<float>(paint.specular())};
}

struct SurfaceLight {
    Eigen::Vector3f diffuse{0, 0, 0};   ///< radiance if the surface were white
    Eigen::Vector3f specular{0, 0, 0};  ///< radiance if the surface reflected all light

    [[nodiscard]] Eigen::Vector3f on(const Paint& paint) const {
        return paint.diffuse.cwiseProduct(diffuse) + paint.specular().cwiseProduct(specular);
    }
};

/// Multiplies the components of two lights. Used where light is stored as a multiple of other
/// light.
[[nodiscard]] inline SurfaceLight product(const SurfaceLight& a, const SurfaceLight& b) {
    return {a.diffuse.cwiseProduct(b.diffuse), a.specular.cwiseProduct(b.specular)};
}

/// Packs the light of a surface, multiplied by `exposure`. The code that unpacks the words knows
/// Paint::diffuse and Paint::facing, but not Paint::albedo. Therefore, the specular light is also
/// multiplied by albedo.full(), and the ratio albedo.offset / albedo.full() is packed with it.
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
/// diffuse light without paint.
[[nodiscard]] inline SurfaceLight lightOf(const Eigen::Vector3f& radiance,
                                          const Eigen::Vector3f& white, const Paint& paint) {
    const Eigen::Vector3f rest = radiance - paint.diffuse.cwiseProduct(white);
    return {white, rest.cwiseMax(0.0F).cwiseQuotient(paint.specular().cwiseMax(kLeastPaint))};
}

}  // namespace mfar
