#include "hal/virtual/synthetic_renderer.h"
#include "hal/virtual/synthetic_store.h"
#include "hal/virtual/synthetic_textures.h"

#include <algorithm>
#include <set>
#include <thread>
#include <vector>

namespace mfar::synthetic {
namespace {

constexpr int kLevels = 11;  // number of mipmap levels, from 1024 down to 1 texel
static_assert(1 << (kLevels - 1) == kLayerSize);

/// Has the same memory layout as Material in synthetic_tables.glsl.
struct MaterialEntry {
    std::array<float, 4> mapping, tint, look;
};

std::vector<cv::Mat4b> paintLayers(const std::vector<Layer>& layers, std::uint64_t seed) {
    const TexelStore store(TexelStore::userFolder());
    std::vector<cv::Mat4b> out(layers.size());
    const auto paintEvery = [&](std::size_t first, std::size_t step) {
        for (std::size_t i = first; i < layers.size(); i += step)
            out[i] = store.get(layerKey(layers[i], seed), kLayerSize,
                               [&] { return makeLayer(layers[i], seed); });
    };
    std::jthread other(paintEvery, 1, 2);
    paintEvery(0, 2);
    other.join();
    return out;
}

}  // namespace

WorldGl::WorldGl(const World& world, std::uint64_t seed)
    : world_(world), light_(bakeLight(world, TexelStore(TexelStore::userFolder()))),
      lightMap_({light_.texels.cols, light_.texels.rows}, gpu::TexelFormat::Rgba8,
                gpu::Filter::Linear),
      materials_(kMaxPrimitives * sizeof(MaterialEntry)), worldPass_("synthetic_world.frag"),
      sensorPass_("synthetic_sensor.frag") {
    lightMap_.upload(PlaneView{light_.texels.ptr(), light_.texels.step});
    uploadLayers(seed);
    uploadMaterials();
    gpu::checkErrors("WorldGl");
}

WorldGl::~WorldGl() {
    glDeleteTextures(1, &layers_);
}

void WorldGl::uploadLayers(std::uint64_t seed) {
    std::set<Layer> used{Layer::Clouds};
    for (const Material& m : world_.materials)
        used.insert(m.layer);
    glGenTextures(1, &layers_);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D_ARRAY, layers_);
    glTexStorage3D(GL_TEXTURE_2D_ARRAY, kLevels, GL_RGBA8, kLayerSize, kLayerSize,
                   static_cast<GLsizei>(used.size()));
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_REPEAT);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const std::vector<Layer> layers(used.begin(), used.end());
    const std::vector<cv::Mat4b> texels = paintLayers(layers, seed);
    for (int slot = 0; slot < static_cast<int>(layers.size()); ++slot) {
        glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, slot, kLayerSize, kLayerSize, 1, GL_RGBA,
                        GL_UNSIGNED_BYTE, texels[slot].ptr());
        slots_[static_cast<std::size_t>(layers[slot])] = slot;
    }
    glGenerateMipmap(GL_TEXTURE_2D_ARRAY);
}

void WorldGl::uploadMaterials() {
    const auto f = [](double v) { return static_cast<float>(v); };
    std::vector<MaterialEntry> entries;
    for (const Material& m : world_.materials)
        entries.push_back(
            {{f(m.repeats.x()), f(m.repeats.y()), f(m.offset.x()), f(m.offset.y())},
             {f(m.tint.x()), f(m.tint.y()), f(m.tint.z()), f(m.variation)},
             {static_cast<float>(slots_[static_cast<std::size_t>(m.layer)]), f(m.gloss), 0, 0}});
    materials_.write(std::span<const MaterialEntry>(entries));
}

}  // namespace mfar::synthetic
