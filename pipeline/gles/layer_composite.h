#pragma once

#include "base/gl/pass.h"
#include "pipeline/composite/virtual_layer.h"
#include "pipeline/engine/occlusion_options.h"
#include "pipeline/engine/params/occlusion.h"

namespace mfar {

/// Draws a virtual layer over the picture of the real scene, except where the real scene is nearer.
/// Real depth has the video's resolution; it is interpolated to the output's resolution along the
/// picture's edges. Only pixels in the layer's bounds are processed.
class LayerComposite {
public:
    /// `layer` is the size of the layers in run(). Throws std::invalid_argument if an option is not
    /// finite or out of range, and GlError if the GL implementation cannot draw into Rg32F.
    LayerComposite(Size video, Size output, Size layer, const CompositeOptions& options = {});
    /// For layers that have the output's size.
    LayerComposite(Size video, Size output, const CompositeOptions& options = {})
        : LayerComposite(video, output, output, options) {}

    /// `realDepth`: Rg32F of video size with inverse depth and its sigma [1/m]. A pixel is unknown,
    /// and hides nothing, unless both values are finite and positive.
    /// `video`: the frame to which the depth belongs, RGBA8 or R8.
    /// `picture`: the same frame at output size, RGBA8. `target` draws into the picture (or into a
    /// copy of it).
    /// A layer pixel is not drawn unless its depth is finite and positive. If the layer is smaller
    /// than the output, colours are interpolated linearly, and depth is that of the nearest valid
    /// pixel of the surrounding four.
    void run(const VirtualLayer& layer, const gpu::Texture& realDepth, const gpu::Texture& video,
             const gpu::Texture& picture, const gpu::Framebuffer& target);

    /// Share of each layer pixel that was drawn; R8, output size. Valid only within the last
    /// bounds.
    [[nodiscard]] const gpu::Texture& visibility() const { return visibility_; }

private:
    [[nodiscard]] params::Visibility visibilityParams() const;
    /// The video pixels whose range is looked up by the output pixels in `bounds`.
    [[nodiscard]] PixelRect videoPixels(const PixelRect& bounds) const;

    Size video_, layer_;
    CompositeOptions options_;
    gpu::Texture range_, visibility_, open_;  // open_ is a depth buffer, see visibility_decide.frag
    gpu::Framebuffer rangeTarget_, visibilityTarget_;
    gpu::DrawPass<params::Visibility> rangePass_, decidePass_, samplePass_, blendPass_;
};

}  // namespace mfar
