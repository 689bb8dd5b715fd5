#include "pipeline/gles/traced_textures.h"

#include <span>
#include <vector>

namespace mfar {

gpu::Texture rayTexture(const CameraModel& camera) {
    const Size size = camera.size;
    std::vector<float> rays;
    rays.reserve(2UL * size.width * size.height);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const Eigen::Vector2d ray =
                camera.unproject({static_cast<double>(x), static_cast<double>(y)});
            rays.push_back(static_cast<float>(ray.x()));
            rays.push_back(static_cast<float>(ray.y()));
        }
    gpu::Texture out(size, gpu::TexelFormat::Rg32F);
    out.upload(std::span<const float>(rays));
    return out;
}

void TracedTextures::upload(const TracedPicture& traced) {
    const Size size = traced.camera.size;
    if (!lens_ || !(picture_.size() == size)) {
        picture_ = gpu::Texture(size, gpu::TexelFormat::Rgba8, gpu::Filter::Linear);
        depth_ = gpu::Texture(size, gpu::TexelFormat::R32F);
        colour_ = gpu::Texture(size, gpu::TexelFormat::Rgba8, gpu::Filter::Linear);
        surface_ = gpu::Texture(size, gpu::TexelFormat::Rgba32F);
        packed_ = gpu::Texture(size, gpu::TexelFormat::R32Ui);
        light_ = gpu::Texture(size, gpu::TexelFormat::Rg32Ui);
        gloss_ = gpu::Texture(size, gpu::TexelFormat::Rg32Ui);
    }
    lens_.emplace(traced.camera);
    picture_.uploadRows(traced.picture);
    depth_.upload(std::span(traced.depth));
    colour_.uploadRows(traced.colour);
    packed_.upload(traced.packed);
    if (!traced.light.empty())
        light_.upload(std::span(&traced.light.front().diffuse, 2 * traced.light.size()));
    if (!traced.gloss.empty())
        gloss_.upload(std::span(&traced.gloss.front().normal, 2 * traced.gloss.size()));
    surface_.upload(std::span(&traced.surface.front().z, 4 * traced.surface.size()));
}

}  // namespace mfar
