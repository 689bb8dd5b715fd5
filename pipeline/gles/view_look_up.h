#pragma once

#include "base/gl/pass.h"
#include "pipeline/composite/lens_projection.h"
#include "pipeline/gles/hole_filler.h"
#include "pipeline/gles/patch_textures.h"
#include "pipeline/gles/reference_textures.h"
#include "pipeline/warp/warp_options.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>

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
    static constexpr int kViews = 1 + PatchPictures::kPatches;
    struct Params {  // warp_view_params.glsl
        float toView[kViews][3][4], pinhole[2][4], distortion[2][4], lens[2][4], plane[4], share[4],
            slack[4];
        std::int32_t sizes[4], bounds[4], counts[4];
        std::array<HoleFiller::Command, HoleFiller::kLevels> wanted;
    };
    static_assert(PatchPictures::kPatches == 4);  // share
    void runRest(const Params& params, const Input& input, const PixelRect& where,
                 const HoleFiller& holes);

    [[nodiscard]] Params params(const Input& input, const RigidTransform& T_world_camera) const;

    LensProjection layer_;
    gpu::Texture rays_, colour_, depth_, state_;
    gpu::Framebuffer target_;
    gpu::Buffer commands_, list_;  // of the pixels that are not plain
    gpu::DrawPass<Params> plain_;
    gpu::ComputePass<Params> restList_, rest_;
};

}  // namespace mfar
