#pragma once

#include "base/gl/pass.h"
#include "pipeline/composite/virtual_layer.h"

#include <cstdint>

namespace mfar {

/// When a real thing hides a virtual one. A sample's sigma here is that of the difference of both
/// inverse depths: of the real one as given, of the virtual one by `virtualSigma`.
struct CompositeOptions {
    /// How much nearer than the virtual surface the real one must be to hide any of it [sigmas]:
    /// what stands on a table is not eaten by it.
    double bias = 0.5;
    /// From there on, how much nearer until all of it is hidden [sigmas], at least 0.01.
    double softness = 1;
    /// Standard deviation of virtual depth, by the pose it is drawn for [share of the depth].
    double virtualSigma = 0.003;
    /// Distance of two colours (RGB, Euclidean) at which a depth sample counts for
    /// exp(-1/2) of its weight [grey levels], above 0.
    double likeness = 12;
};

/// Puts a virtual layer over the picture of the real scene, behind what is nearer there. Real depth
/// comes at video resolution and is brought to the output's along the picture's edges. Only the
/// layer's bounds are worked on.
class Composite {
public:
    /// `layer`: size of the layers that come. Throws std::invalid_argument for an option that is
    /// not finite or out of its range, and GlError where the GL does not draw into Rg32F.
    Composite(Size video, Size output, Size layer, const CompositeOptions& options = {});
    /// For layers of the output's size.
    Composite(Size video, Size output, const CompositeOptions& options = {})
        : Composite(video, output, output, options) {}

    /// `realDepth`: Rg32F, video size: inverse depth, its sigma [1/m]; a pixel whose values are not
    /// both finite and positive is unknown and hides nothing. `video`: the frame the depth belongs
    /// to, RGBA8 or R8. `picture`: that frame at output size, RGBA8; `target` draws into it (or
    /// into a copy). A layer pixel whose depth is not finite and positive is not drawn. Between the
    /// pixels of a smaller layer colours are linear; depth is that of the nearest pixel of the four
    /// around that has one.
    void run(const VirtualLayer& layer, const gpu::Texture& realDepth, const gpu::Texture& video,
             const gpu::Texture& picture, const gpu::Framebuffer& target);

    /// Does a real sample hide, by itself, a surface at inverse depth `inverse` [1/m] wholly?
    [[nodiscard]] bool hides(double rho, double sigma, double inverse) const {
        const double sigmas = options_.bias + options_.softness;
        return rho - sigmas * sigma >= inverse * (1 + sigmas * options_.virtualSigma);
    }

    /// Share of each pixel of the layer that was drawn, R8, output size, within the last bounds.
    [[nodiscard]] const gpu::Texture& visibility() const { return visibility_; }

private:
    struct Params {  // visibility.glsl
        std::int32_t video[4], layer[4];
        float scale[4], tune[4];
    };

    [[nodiscard]] Params params() const;
    /// The video pixels whose range the output pixels of `bounds` look up.
    [[nodiscard]] PixelRect videoPixels(const PixelRect& bounds) const;
    /// The output pixels that pixels of the layer are seen in.
    [[nodiscard]] PixelRect outputPixels(const PixelRect& layerPixels) const;

    Size video_, layer_;
    CompositeOptions options_;
    gpu::Texture range_, visibility_, open_;  // open_: depth, see visibility_decide.frag
    gpu::Framebuffer rangeTarget_, visibilityTarget_;
    gpu::DrawPass<Params> rangePass_, decidePass_, samplePass_, blendPass_;
};

}  // namespace mfar
