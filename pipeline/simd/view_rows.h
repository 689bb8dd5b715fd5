#pragma once

#include "base/rows.h"
#include "pipeline/simd/paint_words.h"
#include "pipeline/simd/point_lens.h"

#include <cstdint>

namespace mfar::simd {

/// A surface in one word, as warp_surface.glsl packs it.
inline constexpr std::uint32_t kCatcherNumber = 255;  ///< kCatcherId
/// Relative difference of z up to which two surfaces are the same.
inline constexpr float kSameDepth = 0.003F;

/// The catcher if it is a plane: n . point = w in the layer's camera [m]; all zero: it is not a
/// plane.
struct CatcherPlane {
    float x = 0, y = 0, z = 0, w = 0;

    /// z [m] along a ray; 0: not in sight.
    [[nodiscard]] float depthAlong(float rayX, float rayY, float nearest) const {
        const float facing = x * rayX + y * rayY + z;
        const float depth = w / (facing == 0 ? 1 : facing);
        return depth > nearest && depth < 1e6F ? depth : 0;
    }
};

/// The reference picture in which a row of the layer is looked up.
struct ViewLookUpInput {
    PointTransform toReference;    ///< from the layer's camera
    PointLens lens;                ///< of the reference
    Size reference;                ///< [px]
    const std::uint32_t* packed;   ///< surfaces of the reference, row-major; number 254: unknown
    const std::uint32_t* colours;  ///< RGBA8, row-major
    const std::uint32_t* lights;   ///< LightWords, two words each; null: only colours are known
    CatcherPlane plane;
    float shownDepth;  ///< factor of the catcher's z: 1 - kShadowLift
};

/// Pixels of a row of the layer.
struct ViewRow {
    int count;
    const std::uint32_t *upper, *lower;  ///< surfaces at twice the resolution
    const PaintWords* paint;             ///< SurfaceRaster::paintRow(); read only if there are
                                         ///< lights
    const float *rayX, *rayY;            ///< normalised
    std::uint32_t* colour;               ///< RGBA8 premultiplied
    float* depth;                        ///< z [m], 0 = nothing
    std::uint32_t* state;                ///< see WarpStep::state()
    std::uint32_t* left;                 ///< indices of the pixels that are left over; room for
                                         ///< all, and 16 more
};

/// Looks up plain pixels: those filled by one surface that the reference picture shows in four
/// texels at the same depth (warp_look_up.frag). Returns how many other pixels are left over.
/// Writes into the padding of rows, which need kPadding.
[[nodiscard]] int lookUpRow(const ViewRow& row, const ViewLookUpInput& input);

}  // namespace mfar::simd
