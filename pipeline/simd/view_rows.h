#pragma once

#include "base/paint_words.h"
#include "base/rows.h"
#include "pipeline/simd/point_lens.h"

#include <cstdint>

namespace mfar::simd {

/// Surface number of the shadow catcher in words packed as in warp_surface.glsl; equals kCatcherId.
inline constexpr std::uint32_t kCatcherNumber = 255;
/// Two pixels with the same surface number show the same part of the surface if their z differs by
/// less than this fraction of z.
inline constexpr float kSameDepth = 0.003F;

/// The shadow catcher, if it is a plane: (x, y, z) . point = w in the layer's camera [m]. All zero
/// if it is not a plane.
struct CatcherPlane {
    float x = 0, y = 0, z = 0, w = 0;

    /// Returns z [m] of the plane on the ray (rayX, rayY, 1); 0 if the plane is not visible there.
    [[nodiscard]] float depthAlong(float rayX, float rayY, float nearest) const {
        const float facing = x * rayX + y * rayY + z;
        const float depth = w / (facing == 0 ? 1 : facing);
        return depth > nearest && depth < 1e6F ? depth : 0;
    }
};

/// The traced picture in which lookUpRow() looks up pixels, and its camera.
struct ViewLookUpInput {
    PointTransform toTraced;  ///< transforms from the layer's to the traced picture's camera
    PointLens lens;
    Size tracedSize;
    const std::uint32_t* packed;   ///< traced picture's surfaces, row-major; number 254: unknown
    const std::uint32_t* colours;  ///< traced picture's colours, RGBA8, row-major
    const std::uint32_t* lights;   ///< LightWords, two words each; null if only colours are known
    CatcherPlane plane;
    float shownDepth;  ///< 1 - kShadowLift; the shadow catcher's z is multiplied by this
    /// The transform `toTraced` for each of the params::kSurfaceNumbers surface numbers; null if no
    /// object moves.
    const PointTransform* ofNumbers = nullptr;
};

struct ViewRow {
    int count;
    const std::uint32_t *upper, *lower;  ///< surfaces of the pixels' upper and lower quarters
    /// Result of SurfaceRaster::paintRow(). Read only if ViewLookUpInput::lights is not null.
    const PaintWords* paint;
    const float *rayX, *rayY;  ///< rays with z = 1
    std::uint32_t* colour;     ///< RGBA8 premultiplied
    float* depth;              ///< z [m]; 0: empty
    std::uint32_t* state;      ///< see WarpStep::state()
    /// Indices of the pixels that were not looked up. The array must have room for `count` + 16
    /// entries.
    std::uint32_t* left;
};

/// Looks up the plain pixels of a row (warp_look_up.frag). In a plain pixel, a single surface fills
/// the pixel, and the four texels around the surface's position in the traced picture show it at
/// the same depth. On a planar shadow catcher, the depths are not compared, and texels without a
/// surface count as catcher without shadow. A pixel without any surface also counts as plain.
/// Returns the number of pixels that are not plain. Writes into the rows' padding of
/// AlignedRows::kPadding bytes.
[[nodiscard]] int lookUpRow(const ViewRow& row, const ViewLookUpInput& input);

}  // namespace mfar::simd
