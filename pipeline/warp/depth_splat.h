#pragma once

#include "base/gl/pass.h"
#include "pipeline/composite/lens_projection.h"
#include "pipeline/warp/pass_params.h"
#include "pipeline/warp/reference_textures.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace mfar {

/// The first pass of the warp (paper, eq. 5): the depth of the reference moved to the current pose,
/// apart for objects and the catcher. Every pixel goes to those of its four neighbours where its
/// bilinear weight is a quarter or more; the nearest z wins, in whatever order they come.
class DepthSplat {
public:
    explicit DepthSplat(const LensProjection& layer);

    /// The layer's pixels of `where` alone are valid afterwards.
    void run(const WarpReference& reference, const ReferenceTextures& textures,
             const RigidTransform& T_world_camera, const PixelRect& where);

    [[nodiscard]] const gpu::Texture& objects() const { return objects_; }  ///< R32F: z [m], 0 none
    [[nodiscard]] const gpu::Texture& catcher() const { return catcher_; }  ///< the same

private:
    void clear(const PixelRect& where);

    LensProjection layer_;
    std::optional<CameraModel> raysOf_;
    gpu::Texture rays_, objects_, catcher_;
    gpu::Buffer nearest_;
    std::vector<std::uint32_t> nothing_;
    gpu::ComputePass<params::SplatDepth> splat_;
    gpu::ComputePass<params::ResolveSplat> resolve_;
};

}  // namespace mfar
