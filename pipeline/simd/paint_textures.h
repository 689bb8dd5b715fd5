#pragma once

#include "pipeline/simd/paint_rows.h"
#include "pipeline/warp/silhouette_models.h"

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace mfar::simd {

/// The textures of a scene's surfaces for paintRow(), in one array. A material's textures of base
/// colour and of metallic are combined into one picture of the larger size, with all pyramid levels
/// down to one texel. Equal materials share one picture.
class PaintTextures {
public:
    struct Material {
        std::uint32_t size, levels, material;
    };

    /// Prepares the pictures of new materials, and keeps those of materials that the previous
    /// objects had. Copies all input. Takes 4 ns per texel.
    void set(std::span<const SilhouetteModels::Object> objects);
    [[nodiscard]] const Material& of(const SilhouetteModels::Part& part) const {
        return materials_.at(&part);
    }
    /// Returns the input of paintRow() with null `triangles`, which the caller must set. Valid
    /// until set().
    [[nodiscard]] PaintInput input() const { return {texels_.data(), levels_.data(), nullptr}; }

private:
    struct Source {
        const SurfaceTexture *colour = nullptr, *metallic = nullptr;
        std::array<float, 4> factor{};

        auto operator<=>(const Source&) const = default;
    };
    struct Picture {
        std::shared_ptr<const Model> model;  // keeps the textures alive, so that no other texture
                                             // gets their address
        std::vector<PaintLevel> levels;      // largest level first
    };
    using Pictures = std::map<Source, Picture>;

    static Source sourceOf(const SilhouetteModels::Part& part);
    static void fill(const Source& source, Size size, std::span<PaintWords> out);
    void setPictures(std::span<const SilhouetteModels::Object> objects);
    void addPicture(Picture& picture, const Source& source);

    Pictures pictures_;
    std::vector<PaintWords> texels_;
    std::vector<PaintLevel> levels_;
    std::map<const SilhouetteModels::Part*, Material> materials_;
};

}  // namespace mfar::simd
