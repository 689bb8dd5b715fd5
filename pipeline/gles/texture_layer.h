#pragma once

#include "pipeline/engine/steps.h"
#include "pipeline/gles/device_copies.h"

#include <cstddef>
#include <optional>
#include <utility>

namespace mfar {

/// Textures of a virtual layer as a LayerPicture. Only pixels within the layer's bounds are
/// downloaded, and those within the bounds of the last download, which may have become 0.
class TextureLayer {
public:
    explicit TextureLayer(Transfers* transfers = nullptr)
        : layer_{Field<std::uint32_t>({}, transfers), Field<float>({}, transfers), {}} {}

    /// Returns the textures (RGBA8 and R32F) as a LayerPicture, which is valid until the next call.
    /// The textures must remain valid until then, and must be 0 outside `bounds`.
    LayerPicture& show(const gpu::Texture& colour, const gpu::Texture& depth,
                       const PixelRect& bounds) {
        layer_.colour.writtenOnDevice(colour_.emplace(colour, bounds, colourOnHost_),
                                      colour.size());
        layer_.depth.writtenOnDevice(depth_.emplace(depth, bounds, depthOnHost_), depth.size());
        layer_.bounds = bounds;
        return layer_;
    }

private:
    class BoundedCopy final : public TextureCopy {
    public:
        /// `onHost`: bounds of the pixels in CPU memory that are not 0.
        BoundedCopy(const gpu::Texture& texture, const PixelRect& bounds, PixelRect& onHost)
            : TextureCopy(texture), bounds_(bounds), onHost_(onHost) {}
        std::size_t download(void* data, std::ptrdiff_t pitch) override {
            const auto [width, height] = texture().size();
            const PixelRect part =
                common(around(bounds_, std::exchange(onHost_, bounds_)), {0, 0, width, height});
            return TextureCopy::download(part, data, pitch);
        }

    private:
        PixelRect bounds_;
        PixelRect& onHost_;
    };

    PixelRect colourOnHost_, depthOnHost_;
    std::optional<BoundedCopy> colour_, depth_;
    LayerPicture layer_;
};

}  // namespace mfar
