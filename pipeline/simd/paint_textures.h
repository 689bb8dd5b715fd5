#pragma once

#include "pipeline/simd/paint_rows.h"
#include "pipeline/warp/silhouette_models.h"

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace mfar::simd {

/// The textures of a scene's surfaces for paintRow(), all in one array: base colour and metallic as
/// one picture at the larger size of both, in all sizes down to one texel. A picture of two
/// textures is held once, whatever shows it.
class PaintTextures {
public:
    /// What a part is painted with: the words of PaintTriangle.
    struct Material {
        std::uint32_t size, levels, factor, material;
    };

    /// Makes pictures that the objects before did not have; keeps the others. Borrows nothing.
    /// Takes 4 ns a texel.
    void set(std::span<const SilhouetteModels::Object> objects);
    /// Of a part of those objects.
    [[nodiscard]] const Material& of(const SilhouetteModels::Part& part) const {
        return materials_.at(&part);
    }
    /// Without triangles. Valid until set().
    [[nodiscard]] PaintInput input() const {
        return {texels_.data(), levels_.data(), nullptr, factors_.data()};
    }

private:
    /// Base colour, metallic-roughness.
    using Textures = std::pair<const SurfaceTexture*, const SurfaceTexture*>;
    struct Picture {
        std::shared_ptr<const Model> model;  // owns the textures: their addresses are not used anew
        std::vector<PaintLevel> levels;      // largest first
    };
    using Pictures = std::map<Textures, Picture>;

    static Textures texturesOf(const SilhouetteModels::Part& part);
    void setPictures(std::span<const SilhouetteModels::Object> objects);
    void addPicture(Picture& picture, const Textures& textures);

    Pictures pictures_;
    std::vector<std::uint32_t> texels_;
    std::vector<PaintLevel> levels_;
    std::vector<float> factors_;
    std::map<const SilhouetteModels::Part*, Material> materials_;
};

}  // namespace mfar::simd
