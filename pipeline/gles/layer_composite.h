#pragma once

#include "base/gl/pass.h"
#include "pipeline/composite/virtual_layer.h"
#include "pipeline/engine/occlusion_options.h"
#include "pipeline/engine/params/occlusion.h"

namespace mfar {

/// Draws a virtual layer over the picture of the real scene, except where the real scene is nearer.
/// Real depth has the video's resolution; it is brought to the output's along the picture's edges.
/// Processes only the layer's bounds.
class LayerComposite {
public:
    /// `layer`: size of the layers in run(). Throws std::invalid_argument for an option that is not
    /// finite or out of its range, and GlError where the GL does not draw into Rg32F.
    LayerComposite(Size video, Size output, Size layer, const CompositeOptions& options = {});
    /// For layers of the output's size.
    LayerComposite(Size video, Size output, const CompositeOptions& options = {})
        : LayerComposite(video, output, output, options) {}

    /// `realDepth`: Rg32F, video size: inverse depth, its sigma [1/m]; a pixel whose values are not
    /// both finite and positive is unknown and hides nothing. `video`: the frame the depth belongs
    /// to, RGBA8 or R8. `picture`: that frame at output size, RGBA8; `target` draws into it (or
    /// into a copy). A layer pixel whose depth is not finite and positive is not drawn. In a
    /// smaller layer, colours are interpolated linearly, and depth is that of the nearest valid
    /// pixel of the surrounding four.
    void run(const VirtualLayer& layer, const gpu::Texture& realDepth, const gpu::Texture& video,
             const gpu::Texture& picture, const gpu::Framebuffer& target);

    /// Share of each layer pixel that was drawn, R8, output size, within the last bounds.
    [[nodiscard]] const gpu::Texture& visibility() const { return visibility_; }

private:
    [[nodiscard]] params::Visibility visibilityParams() const;
    /// The video pixels whose range the output pixels of `bounds` look up.
    [[nodiscard]] PixelRect videoPixels(const PixelRect& bounds) const;

    Size video_, layer_;
    CompositeOptions options_;
    gpu::Texture range_, visibility_, open_;  // open_ holds depth, see visibility_decide.frag
    gpu::Framebuffer rangeTarget_, visibilityTarget_;
    gpu::DrawPass<params::Visibility> rangePass_, decidePass_, samplePass_, blendPass_;
};

}  // namespace mfar
