#pragma once

#include "pipeline/composite/pass_params.h"

#include <cstdint>

// Constants and parameters of the passes that warp rendered pictures: warp_*.comp, warp_*.frag,
// warp_silhouette.vert. gles_shaders/params_to_glsl.cmake converts this header to GLSL.
namespace mfar::params {

/// Surface numbers in packed surfaces: the shadow catcher, and a number that stands for any object.
inline constexpr std::uint32_t kCatcherNumber = 255U;
inline constexpr std::uint32_t kAnyObjectNumber = 254U;
/// Two depths are on the same surface if they differ by less than this share of z.
inline constexpr float kSameDepth = 0.003F;
/// If the summed weights of a surface's own texels are below this limit, the surface's interpolated
/// colour is unreliable.
inline constexpr float kLeastLookUpWeight = 0.2F;
/// Number of pyramid levels that suffice to fill a crack.
inline constexpr int kCrackLevels = 2;
/// Number of contrast levels in EdgeRefiner.
inline constexpr std::uint32_t kContrastLevels = 64U;

/// One mesh of the virtual scene.
struct alignas(16) SilhouetteMesh {
    Transform object;  ///< T_camera_object, multiplied by the object's scale
    Projection layer;
    float width, height;  ///< size of the layer [px]
    float number;         ///< number of the object
    float cutoff;         ///< points with a smaller alpha are holes
};

/// A picture in which colours are looked up. The first is the traced picture; the others are
/// re-rendered pictures.
struct alignas(16) View {
    Transform toView;  ///< T_view_camera
    float share;       ///< a re-rendered picture's share in the displayed colour
};

/// Plane of a planar shadow catcher, in the layer's camera frame: normal . point = offset [m]. All
/// 0 if the catcher is not planar.
struct alignas(16) Plane {
    float x, y, z;
    float offset;
};

/// Numbers of workgroups of an indirect dispatch over a list.
struct alignas(16) DispatchGroups {
    std::uint32_t x, y, z;
    std::uint32_t count;  ///< number of entries in the list
};

struct alignas(16) LookUpViews {
    View views[5];
    Projection projections[2];  ///< traced picture; layer and re-rendered pictures
    Plane plane;
    PixelBounds bounds;
    DispatchGroups wanted[6];                ///< dispatches of the pyramid's levels
    std::int32_t tracedWidth, tracedHeight;  ///< size of the traced picture [px]
    std::int32_t width, height;              ///< size of the layer [px]
    std::int32_t rerendered, levels;
};

/// A level of the pyramid that fills holes.
struct alignas(16) HoleLevel {
    std::int32_t first;  ///< index of the level's first texel in the pyramid
    std::int32_t columns;
    std::int32_t originX, originY;  ///< [texels of this level]
};

struct alignas(16) FillHoles {
    PixelBounds bounds;
    HoleLevel levels[6];    ///< levels 1 to 6
    std::int32_t width;     ///< width of the layer [px]
    std::int32_t fillsAll;  ///< 1: larger holes than cracks are filled too
    std::int32_t level;     ///< level computed by this pass
    std::int32_t levelCount;
    std::int32_t rows, rowsBelow;  ///< rows of the computed level and of the level below
    std::int32_t texels;           ///< number of texels of all levels
};

/// Parameters for sharpening edge pixels while the camera rests.
struct alignas(16) RefineEdges {
    PixelBounds bounds;
    std::int32_t width;          ///< width of the layer [px]
    std::int32_t shown;          ///< number of pixels in the answer
    std::int32_t leastContrast;  ///< least contrast level that is listed
    std::int32_t mostListed;     ///< largest number of listed pixels
    float renderedShare;         ///< share of the rendered colour in the displayed colour
    float listedShare;           ///< share of the objects' pixels that is listed
};

}  // namespace mfar::params
