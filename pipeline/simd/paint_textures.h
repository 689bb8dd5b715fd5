#pragma once

#include "pipeline/simd/paint_rows.h"
#include "pipeline/warp/paint_pyramid.h"

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace mfar::simd {

/// The paint of a scene's surfaces for paintRow(), in one array of all levels of all pyramids (see
/// paintPyramid()). Equal materials share one pyramid.
class PaintTextures {
public:
    struct Material {
        std::uint32_t size, levels, material;
    };

    /// Prepares the pictures of the objects' materials. Pictures that are already prepared for the
    /// previous objects are kept. Copies all input. Preparation takes 4 ns per texel.
    void set(std::span<const SilhouetteModels::Object> objects);
    [[nodiscard]] const Material& of(const SilhouetteModels::Part& part) const {
        return materials_.at(&part);
    }
    /// Returns the input of paintRow() without its `triangles`, which the caller must set. The
    /// input is valid until the next call of set().
    [[nodiscard]] PaintInput input() const { return {texels_.data(), levels_.data(), nullptr}; }

private:
    struct Picture {
        // Keeps the textures alive. PaintSource identifies a texture by its address, so no new
        // texture may get the address of an old one.
        std::shared_ptr<const Model> model;
        std::vector<PaintLevel> levels;  // largest level first
    };
    using Pictures = std::map<PaintSource, Picture>;

    void setPictures(std::span<const SilhouetteModels::Object> objects);
    void addPicture(Picture& picture, const PaintSource& source);

    Pictures pictures_;
    std::vector<PaintWords> texels_;
    std::vector<PaintLevel> levels_;
    std::map<const SilhouetteModels::Part*, Material> materials_;
};

}  // namespace mfar::simd
