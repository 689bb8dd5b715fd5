#pragma once

#include "pipeline/engine/steps.h"
#include "pipeline/gles/device_copies.h"

#include <optional>

namespace mfar {

class TextureLayer {
public:
    explicit TextureLayer(Transfers* transfers = nullptr)
        : layer_{Field<std::uint32_t>({}, transfers), Field<float>({}, transfers), {}} {}

    /// Returns the textures (RGBA8 and R32F) as a LayerPicture, which is valid until the next call.
    /// The textures must remain valid until then.
    LayerPicture& show(const gpu::Texture& colour, const gpu::Texture& depth,
                       const PixelRect& bounds) {
        layer_.colour.writtenOnDevice(colour_.emplace(colour), colour.size());
        layer_.depth.writtenOnDevice(depth_.emplace(depth), depth.size());
        layer_.bounds = bounds;
        return layer_;
    }

private:
    std::optional<TextureCopy> colour_, depth_;
    LayerPicture layer_;
};

}  // namespace mfar
