#pragma once

#include "base/gl/pass.h"
#include "pipeline/composite/lens_projection.h"
#include "pipeline/gles/hole_filler.h"
#include "pipeline/gles/rerendered_textures.h"
#include "pipeline/gles/traced_textures.h"
#include "pipeline/warp/pass_params.h"
#include "pipeline/warp/warp_options.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <iterator>

namespace mfar {

/// The look-up of the warp (paper, eq. 5). For each surface that ModelSilhouette has drawn at the
/// current pose, it looks up the colour in the traced picture or, if that does not show the
/// surface, in the re-rendered pictures. A draw call processes simple pixels. A compute shader
/// processes a list of all others, for example edges.
class ViewLookUp {
public:
    explicit ViewLookUp(const LensProjection& layer);

    struct Input {
        const gpu::Texture& silhouette;
        const TracedTextures& traced;
        const RigidTransform& T_world_traced;
        const RerenderedPictures& rerendered;
        const RerenderedTextures& rerenderedTextures;
        /// Plane of the shadow catcher: n . point = w in the world [m]. Zero if there is no
        /// catcher, or if it is not a plane and `silhouette` therefore shows it.
        Eigen::Vector4d plane = Eigen::Vector4d::Zero();
    };
    /// Computes colour(), depth() and state() for the pixels in `where`, and no others. Adds pixels
    /// without a known colour to the list in `holes`.
    void run(const Input& input, const RigidTransform& T_world_camera, const PixelRect& where,
             const HoleFiller& holes);
    void clear(const PixelRect& where) const;

    /// RGBA8 premultiplied, and R32F.
    [[nodiscard]] const gpu::Texture& colour() const { return colour_; }
    [[nodiscard]] const gpu::Texture& depth() const { return depth_; }
    /// State of each pixel, RGBA8. R: number of the surface with unknown colour. G: share of the
    /// pixel with unknown colour. B: 1 if no picture shows this surface. A: number of a surface
    /// that fills the whole pixel with a known colour.
    [[nodiscard]] const gpu::Texture& state() const { return state_; }

private:
    using Params = params::LookUpViews;
    static_assert(RerenderedPictures::kPictures + 1 == std::size(Params{}.views));
    static_assert(HoleFiller::kLevels == std::size(Params{}.wanted));
    void runRest(const Params& params, const Input& input, const PixelRect& where,
                 const HoleFiller& holes);

    [[nodiscard]] Params paramsOf(const Input& input, const RigidTransform& T_world_camera) const;

    LensProjection layer_;
    gpu::Texture rays_, colour_, depth_, state_;
    gpu::Framebuffer target_;
    gpu::Buffer commands_, list_;
    gpu::DrawPass<Params> plain_;
    gpu::ComputePass<Params> restList_, rest_;
};

}  // namespace mfar
