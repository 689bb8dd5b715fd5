#pragma once

#include "pipeline/composite/pass_params.h"

#include <cstdint>

// The warp of rendered pictures: warp_*.comp, warp_*.frag, warp_silhouette.vert. Shaders read this
// header, too: gles_shaders/params_to_glsl.cmake.
namespace mfar::params {

/// Number of what shadows fall on, and of any object, in packed surfaces.
inline constexpr std::uint32_t kCatcherNumber = 255U;
inline constexpr std::uint32_t kAnyObjectNumber = 254U;
/// Share of z: surfaces as close as that are one.
inline constexpr float kSameDepth = 0.003F;
/// Less of a surface's own texels than so much tells little of its colour there.
inline constexpr float kLeastLookUpWeight = 0.2F;
/// Levels of the pyramid that a crack needs.
inline constexpr int kCrackLevels = 2;
/// Levels of contrast of EdgeRefiner.
inline constexpr std::uint32_t kContrastLevels = 64U;

/// One mesh of the virtual scene.
struct alignas(16) SilhouetteMesh {
    Transform object;  ///< T_camera_object, the object's scale in it
    Projection layer;
    float width, height;  ///< of the layer [px]
    float number;         ///< of the object
    float cutoff;         ///< of its alpha
};

/// A picture that is looked up in: the reference, then the patches.
struct alignas(16) View {
    Transform toView;  ///< T_view_camera
    float share;       ///< of a patch in what is shown
};

/// A catcher that is a plane: normal . point = offset, the layer's camera [m]; else 0.
struct alignas(16) Plane {
    float x, y, z;
    float offset;
};

/// Groups of a dispatch over a list.
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

/// A level of the pyramid over the holes.
struct alignas(16) HoleLevel {
    std::int32_t first;  ///< texel of the pyramid
    std::int32_t columns;
    std::int32_t originX, originY;  ///< [texels of the level]
};

struct alignas(16) FillHoles {
    PixelBounds bounds;
    HoleLevel levels[6];    ///< from 1 on
    std::int32_t width;     ///< of the layer [px]
    std::int32_t fillsAll;  ///< 1: holes beyond cracks are filled
    std::int32_t level;     ///< that this pass makes
    std::int32_t levelCount;
    std::int32_t rows, rowsBelow;  ///< of the level this pass makes, of the one below
    std::int32_t texels;           ///< of all levels
};

/// What is sharpened in a picture at rest.
struct alignas(16) RefineEdges {
    PixelBounds bounds;
    std::int32_t width;          ///< of the layer [px]
    std::int32_t shown;          ///< pixels to show
    std::int32_t leastContrast;  ///< level
    std::int32_t mostListed;     ///< pixels
    float renderedShare;         ///< of what was rendered in what is shown
    float listedShare;           ///< of the objects' pixels that are listed
};

}  // namespace mfar::params
