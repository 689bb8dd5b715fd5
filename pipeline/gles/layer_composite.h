#pragma once

#include "base/gl/pass.h"
#include "pipeline/composite/virtual_layer.h"
#include "pipeline/engine/occlusion_options.h"
#include "pipeline/engine/params/occlusion.h"

namespace mfar {

/// Draws a virtual layer over the picture of the real scene, except where the real scene is nearer.
/// The real scene's depth has the video's resolution. It is interpolated to the output's resolution
/// so that depth edges follow image edges. Only pixels in the layer's bounds are processed.
class LayerComposite {
public:
    /// `layer` is the size of the layers for run(). Throws std::invalid_argument if an option is
    /// not finite or out of range, and GlError if the GL implementation cannot draw into Rg32F.
    LayerComposite(Size video, Size output, Size layer, const CompositeOptions& options = {});
    LayerComposite(Size video, Size output, const CompositeOptions& options = {})
        : LayerComposite(video, output, output, options) {}

    /// `realDepth` is Rg32F of video size: inverse depth and its sigma [1/m]. If one of them is not
    /// valid (see params::kLeastInverseDepth), the pixel's depth is unknown and hides nothing.
    /// `video` is the video frame to which the depth belongs, RGBA8 or R8. `picture` is this frame
    /// at output size, RGBA8. `target` draws into the picture or into a copy of it.
    ///
    /// Layer pixels are drawn only if their depth is between params::kLeastVirtualDepth and
    /// kMostVirtualDepth. If the layer's size differs from the output's, colours are interpolated
    /// linearly. The depth is then copied from one of the four surrounding layer pixels: of those
    /// with a valid depth, the one closest to the output pixel.
    void run(const VirtualLayer& layer, const gpu::Texture& realDepth, const gpu::Texture& video,
             const gpu::Texture& picture, const gpu::Framebuffer& target);

    /// Visibility of the layer at each output pixel after the last run(), [0, 1]; R8. Valid only
    /// within the bounds of the layer.
    [[nodiscard]] const gpu::Texture& visibility() const { return visibility_; }

private:
    [[nodiscard]] params::Visibility visibilityParams() const;
    [[nodiscard]] PixelRect videoPixels(const PixelRect& bounds) const;

    Size video_, layer_;
    CompositeOptions options_;
    gpu::Texture range_, visibility_, open_;
    gpu::Framebuffer rangeTarget_, visibilityTarget_;
    gpu::DrawPass<params::Visibility> rangePass_, decidePass_, samplePass_, blendPass_;
};

}  // namespace mfar
