#pragma once

#include "base/gl/pass.h"
#include "pipeline/composite/lens_projection.h"
#include "pipeline/gles/eye_light.h"
#include "pipeline/gles/hole_filler.h"
#include "pipeline/gles/model_silhouette.h"
#include "pipeline/gles/rerendered_textures.h"
#include "pipeline/gles/traced_textures.h"
#include "pipeline/warp/pass_params.h"
#include "pipeline/warp/warp_options.h"

#include <array>
#include <cstdint>
#include <iterator>
#include <optional>

namespace mfar {

/// Looks up the colours of a warped picture (eq. 5 of the paper, see docs/paper.md).
/// ModelSilhouette has drawn the surfaces that are visible at the current pose. The light on a
/// surface comes from the traced picture. If the traced picture does not show an object's surface,
/// the light comes from the re-rendered pictures. Pictures without light give finished colours
/// instead. A draw call processes simple pixels. A compute shader processes a list of all other
/// pixels, for example at edges.
class ViewLookUp {
public:
    explicit ViewLookUp(const LensProjection& layer);

    struct Input {
        const ModelSilhouette& silhouette;  ///< the objects at their current poses
        const TracedTextures& traced;
        const TracedPicture& picture;  ///< the picture that was uploaded to `traced`
        const RerenderedPictures& rerendered;
        const RerenderedTextures& rerenderedTextures;
    };
    /// Must be called before run() if objects move. Compiles shaders at the first call.
    void prepareMotion();
    /// Computes colour(), depth() and state() for the pixels in `where`, and no others. Adds pixels
    /// without a known colour to the list in `holes`.
    void run(const Input& input, const RigidTransform& T_world_camera, const PixelRect& where,
             const HoleFiller& holes);
    void clear(const PixelRect& where) const;
    /// Must be called after a traced picture was uploaded to the textures that run() gets.
    void setTracedPicture(const TracedPicture& traced, const TracedTextures& textures) {
        light_.setTracedPicture(traced, textures);
    }

    /// colour() is RGBA8, premultiplied. depth() is R32F: z with which the layer is drawn [m], or 0
    /// where nothing is drawn.
    [[nodiscard]] const gpu::Texture& colour() const { return colour_; }
    [[nodiscard]] const gpu::Texture& depth() const { return depth_; }
    /// State of each pixel, RGBA8; see WarpStep::state().
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
    EyeLight light_;
    gpu::Framebuffer target_;
    gpu::Buffer commands_, list_;
    /// The passes that look up the surfaces' colours. `plain` draws the simple pixels, and `rest`
    /// computes the pixels in the list.
    struct Passes {
        gpu::DrawPass<Params> plain;
        gpu::ComputePass<Params> rest;
    };
    /// Passes for moving objects. `views` has three texels for each view and surface number: the
    /// rows of the transform from the layer's camera to the view.
    struct Motion {
        Passes passes;
        gpu::Texture views;
    };
    void upload(const Input& input, const RigidTransform& T_world_camera);
    [[nodiscard]] bool showsMotion(const Input& input) const;

    Passes still_;
    std::optional<Motion> motion_;
    gpu::ComputePass<Params> restList_;
};

}  // namespace mfar
