#include "pipeline/gles/reference_textures.h"

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

void ReferenceTextures::upload(const WarpReference& reference) {
    const Size size = reference.camera.size;
    if (!lens_ || !(picture_.size() == size)) {
        picture_ = gpu::Texture(size, gpu::TexelFormat::Rgba8, gpu::Filter::Linear);
        depth_ = gpu::Texture(size, gpu::TexelFormat::R32F);
        colour_ = gpu::Texture(size, gpu::TexelFormat::Rgba8, gpu::Filter::Linear);
        surface_ = gpu::Texture(size, gpu::TexelFormat::Rgba32F);
        packed_ = gpu::Texture(size, gpu::TexelFormat::R32Ui);
    }
    lens_.emplace(reference.camera);
    picture_.uploadRows(reference.picture);
    depth_.upload(std::span(reference.depth));
    colour_.uploadRows(reference.colour);
    packed_.upload(reference.packed);
    surface_.upload(std::span(&reference.surface.front().z, 4 * reference.surface.size()));
}

}  // namespace mfar
