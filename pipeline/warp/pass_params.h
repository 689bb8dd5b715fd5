#pragma once

#include "pipeline/composite/pass_params.h"

#include <cstdint>

// The warp of rendered pictures: warp_*.comp, warp_*.frag, warp_silhouette.vert. Shaders read this
// header, too: gles_shaders/params_to_glsl.cmake.
namespace mfar::params {

/// In packed surfaces: number of the catcher; number that stands for any object.
inline constexpr std::uint32_t kCatcherNumber = 255U;
inline constexpr std::uint32_t kAnyObjectNumber = 254U;
/// Surfaces whose depths differ by less are the same one [share of z].
inline constexpr float kSameDepth = 0.003F;
/// Lower limit of the summed weights of a surface's own texels: below it, its colour is unreliable.
inline constexpr float kLeastLookUpWeight = 0.2F;
/// Pyramid levels needed to fill a crack.
inline constexpr int kCrackLevels = 2;
/// Number of contrast levels in EdgeRefiner.
inline constexpr std::uint32_t kContrastLevels = 64U;

/// One mesh of the virtual scene.
struct alignas(16) SilhouetteMesh {
    Transform object;  ///< T_camera_object, including the object's scale
    Projection layer;
    float width, height;  ///< of the layer [px]
    float number;         ///< of the object
    float cutoff;         ///< alpha below it is a hole
};

/// A picture used for look-ups: the reference, then the patches.
struct alignas(16) View {
    Transform toView;  ///< T_view_camera
    float share;       ///< of a patch in the displayed colour
};

/// A planar catcher: normal . point = offset, in the layer's camera frame [m]; otherwise 0.
struct alignas(16) Plane {
    float x, y, z;
    float offset;
};

/// Group counts of a dispatch over a list.
struct alignas(16) DispatchGroups {
    std::uint32_t x, y, z;
    std::uint32_t count;  ///< entries of the list
};

struct alignas(16) LookUpViews {
    View views[5];
    Projection projections[2];  ///< of the reference; of the layer and the patches
    Plane plane;
    PixelBounds bounds;
    DispatchGroups wanted[6];                      ///< of the pyramid's levels
    std::int32_t referenceWidth, referenceHeight;  ///< [px]
    std::int32_t width, height;                    ///< of the layer [px]
    std::int32_t patches, levels;
};

/// A level of the pyramid that fills holes.
struct alignas(16) HoleLevel {
    std::int32_t first;  ///< index of its first texel in the pyramid
    std::int32_t columns;
    std::int32_t originX, originY;  ///< [texels of the level]
};

struct alignas(16) FillHoles {
    PixelBounds bounds;
    HoleLevel levels[6];    ///< levels 1 to 6
    std::int32_t width;     ///< of the layer [px]
    std::int32_t fillsAll;  ///< 1: holes beyond cracks are filled
    std::int32_t level;     ///< level computed by this pass
    std::int32_t levelCount;
    std::int32_t rows, rowsBelow;  ///< of the level computed by this pass, of the level below
    std::int32_t texels;           ///< total of all levels
};

/// Pixels that are sharpened while the camera rests.
struct alignas(16) RefineEdges {
    PixelBounds bounds;
    std::int32_t width;          ///< of the layer [px]
    std::int32_t shown;          ///< number of pixels in the answer
    std::int32_t leastContrast;  ///< level
    std::int32_t mostListed;     ///< pixels
    float renderedShare;         ///< share of the rendered colour in the displayed one
    float listedShare;           ///< share of the objects' pixels that are listed
};

}  // namespace mfar::params
