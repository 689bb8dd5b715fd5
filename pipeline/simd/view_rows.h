#pragma once

#include "base/rows.h"
#include "pipeline/simd/paint_words.h"
#include "pipeline/simd/point_lens.h"

#include <cstdint>

namespace mfar::simd {

/// A surface in one word, as warp_surface.glsl packs it.
inline constexpr std::uint32_t kCatcherNumber = 255;  ///< kCatcherId
/// Of z: surfaces as close as that are one.
inline constexpr float kSameDepth = 0.003F;

/// The catcher, if it is one plane: n . point = w in the layer's camera [m]; zero: it is none.
struct CatcherPlane {
    float x = 0, y = 0, z = 0, w = 0;

    /// z [m] along a ray, 0: not in sight.
    [[nodiscard]] float depthAlong(float rayX, float rayY, float nearest) const {
        const float facing = x * rayX + y * rayY + z;
        const float depth = w / (facing == 0 ? 1 : facing);
        return depth > nearest && depth < 1e6F ? depth : 0;
    }
};

/// What a row of the layer is looked up in.
struct ViewLookUpInput {
    PointTransform toReference;    ///< from the layer's camera
    PointLens lens;                ///< of the reference
    Size reference;                ///< [px]
    const std::uint32_t* packed;   ///< its surfaces, row-major; number 254: nothing is known
    const std::uint32_t* colours;  ///< RGBA8, row-major
    const std::uint32_t* lights;   ///< LightWords, two words each; null: colours alone are known
    CatcherPlane plane;
    float shownDepth;  ///< of the catcher's z: 1 - kShadowLift
};

/// Pixels of a row of the layer.
struct ViewRow {
    int count;
    const std::uint32_t *upper, *lower;  ///< surfaces at twice the resolution
    const PaintWords* paint;             ///< SurfaceRaster::paintRow(); with lights alone
    const float *rayX, *rayY;            ///< normalised
    std::uint32_t* colour;               ///< RGBA8 premultiplied
    float* depth;                        ///< z [m], 0 = nothing
    std::uint32_t* state;                ///< see WarpStep::state()
    std::uint32_t* left;                 ///< indices of pixels that are left; room for all and 16
};

/// Plain pixels: those that one surface fills, which the reference shows at four texels and at the
/// same depth (warp_look_up.frag). Returns how many others are left. Rows have kPadding to spare,
/// into which it writes.
[[nodiscard]] int lookUpRow(const ViewRow& row, const ViewLookUpInput& input);

}  // namespace mfar::simd
