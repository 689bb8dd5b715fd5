#pragma once

#include "base/gl/pass.h"
#include "pipeline/gles/traced_textures.h"
#include "pipeline/warp/pass_params.h"

#include <memory>
#include <optional>

namespace mfar {

/// Computes how the light on a traced picture's objects looks from another camera position (the
/// eye). Distant light that the objects mirror depends on this position, so it is computed again.
/// GPU version of the SIMD engine's MovingMirrors.
class EyeLight {
public:
    explicit EyeLight(const CameraModel& layer);

    /// `textures` must contain `traced`. Both must live until the next call of setTracedPicture().
    void setTracedPicture(const TracedPicture& traced, const TracedTextures& textures);
    /// False before the first traced picture, and if the picture has colours but no light.
    [[nodiscard]] bool isLit() const { return traced_ != nullptr && !traced_->light.empty(); }
    /// Computes the textures for the position `eye` in the world. `rays` is the rayTexture() of the
    /// layer's camera. Does nothing if isLit() is false. Mirrored light is unchanged if the pixels'
    /// gloss is unknown, or if the traced picture has another camera model than the layer.
    void run(const Eigen::Vector3d& eye, const gpu::Texture& rays);

    /// RGBA16F textures, see struct Light in warp_light.glsl. Their size is that of the last traced
    /// picture with light, or one texel before the first. Outside TracedPicture::bounds, the values
    /// are finite, but have no meaning.
    [[nodiscard]] const gpu::Texture& diffuse() const { return diffuse_; }
    [[nodiscard]] const gpu::Texture& specular() const { return specular_; }

private:
    using Params = params::EyeLight;
    void uploadTables();
    void clear() const;
    [[nodiscard]] bool mirrorsMove() const;
    [[nodiscard]] Params paramsFor(const Eigen::Vector3d& eye) const;

    CameraModel layer_;
    const TracedPicture* traced_ = nullptr;
    const TracedTextures* textures_ = nullptr;
    std::shared_ptr<const MirrorLight> mirrors_;
    std::optional<Eigen::Vector3d> eye_;  // position of the last run(); empty: the picture is new
    gpu::Texture diffuse_, specular_, tables_, looks_;
    gpu::Framebuffer target_;
    gpu::DrawPass<Params> pass_;
};

}  // namespace mfar
