#pragma once

#include "base/gl/pass.h"
#include "pipeline/composite/lens_projection.h"
#include "pipeline/gles/hole_filler.h"
#include "pipeline/gles/patch_textures.h"
#include "pipeline/gles/reference_textures.h"
#include "pipeline/warp/pass_params.h"
#include "pipeline/warp/warp_options.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <iterator>

namespace mfar {

/// The look-up of the warp (paper, eq. 5), whose depth is that of the models, rasterised at the
/// current pose: every pixel of the layer that shows a surface looks its colour up
/// in the reference or, where that does not show it, in the patches. Plain pixels are done by a
/// draw, edges and what else is not as simple by a compute shader over their list.
class ViewLookUp {
public:
    explicit ViewLookUp(const LensProjection& layer);

    struct Input {
        const gpu::Texture& silhouette;  ///< ModelSilhouette::surface() at the current pose
        const ReferenceTextures& reference;
        const RigidTransform& T_world_reference;
        const PatchPictures& patches;
        const PatchTextures& patchTextures;
        /// The catcher, if it is one plane: n . point = w in the world [m]; zero: it is in the
        /// silhouette, or there is none.
        Eigen::Vector4d plane = Eigen::Vector4d::Zero();
    };
    /// Writes every pixel of `where`, and no other; appends to the list that `holes` has begun.
    void run(const Input& input, const RigidTransform& T_world_camera, const PixelRect& where,
             const HoleFiller& holes);
    /// Nothing at all in these pixels.
    void clear(const PixelRect& where) const;

    [[nodiscard]] const gpu::Texture& colour() const { return colour_; }  ///< RGBA8 premultiplied
    [[nodiscard]] const gpu::Texture& depth() const { return depth_; }    ///< R32F
    /// RGBA8: number of what is missing, its share of the pixel, 1 where it is known nowhere,
    /// number of what fills the pixel alone.
    [[nodiscard]] const gpu::Texture& state() const { return state_; }

private:
    using Params = params::LookUpViews;
    static_assert(PatchPictures::kPatches + 1 == std::size(Params{}.views));
    static_assert(HoleFiller::kLevels == std::size(Params{}.wanted));
    void runRest(const Params& params, const Input& input, const PixelRect& where,
                 const HoleFiller& holes);

    [[nodiscard]] Params paramsOf(const Input& input, const RigidTransform& T_world_camera) const;

    LensProjection layer_;
    gpu::Texture rays_, colour_, depth_, state_;
    gpu::Framebuffer target_;
    gpu::Buffer commands_, list_;  // of the pixels that are not plain
    gpu::DrawPass<Params> plain_;
    gpu::ComputePass<Params> restList_, rest_;
};

}  // namespace mfar
