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

/// The look-up of the warp (paper, eq. 5), with the depth of the models rasterised at the current
/// pose: every layer pixel that shows a surface looks its colour up in the reference or, if the
/// reference does not show the surface, in the patches. A draw handles plain pixels; a compute
/// shader handles a list of edges and other complex pixels.
class ViewLookUp {
public:
    explicit ViewLookUp(const LensProjection& layer);

    struct Input {
        const gpu::Texture& silhouette;  ///< ModelSilhouette::surface() at the current pose
        const ReferenceTextures& reference;
        const RigidTransform& T_world_reference;
        const PatchPictures& patches;
        const PatchTextures& patchTextures;
        /// The catcher, if it is one plane: n . point = w in the world [m]; zero: the catcher is in
        /// the silhouette, or there is none.
        Eigen::Vector4d plane = Eigen::Vector4d::Zero();
    };
    /// Writes exactly the pixels of `where`; appends to the list that `holes` has started.
    void run(const Input& input, const RigidTransform& T_world_camera, const PixelRect& where,
             const HoleFiller& holes);
    /// Empties these pixels.
    void clear(const PixelRect& where) const;

    [[nodiscard]] const gpu::Texture& colour() const { return colour_; }  ///< RGBA8 premultiplied
    [[nodiscard]] const gpu::Texture& depth() const { return depth_; }    ///< R32F
    /// RGBA8: number of the missing surface, its share of the pixel, 1 where no picture shows it,
    /// number of the surface that fills the pixel alone.
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
