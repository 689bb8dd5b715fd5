#include "pipeline/gles/rerendered_textures.h"

#include <span>
#include <vector>

namespace mfar {

RerenderedTextures::RerenderedTextures(Size layer)
    : layer_(layer),
      colour_({layer.width, RerenderedPictures::kPictures * layer.height}, gpu::TexelFormat::Rgba8),
      surface_(colour_.size(), gpu::TexelFormat::Rgba32F),
      light_(colour_.size(), gpu::TexelFormat::Rg32Ui) {
    const std::size_t pixels = static_cast<std::size_t>(layer.width) * layer.height;
    const std::vector<std::array<std::uint8_t, 4>> colours(pixels);
    const std::vector<WarpSurface> surfaces(pixels);
    for (int slot = 0; slot < RerenderedPictures::kPictures; ++slot)
        store({slot, 0, layer.height, colours, {}, surfaces});
}

void RerenderedTextures::store(const RerenderedPictures::StoredRows& rows) {
    const int top = rows.slot * layer_.height + rows.firstRow;
    surface_.upload(std::span(&rows.surfaces.front().z, 4 * rows.surfaces.size()), top);
    colour_.uploadRows(rows.colours, top);
    if (rows.lights.empty()) return;
    light_.upload(std::span(&rows.lights.front().diffuse, 2 * rows.lights.size()), top);
    isLit_ = true;
}

}  // namespace mfar
