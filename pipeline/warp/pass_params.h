#pragma once

#include "pipeline/composite/pass_params.h"

#include <cstdint>

// Constants and parameters of the passes that warp rendered pictures: warp_*.comp, warp_*.frag,
// warp_silhouette.vert. gles_shaders/params_to_glsl.cmake converts this header to GLSL.
namespace mfar::params {

/// Surface numbers in packed surfaces (see warp_surface.glsl). kCatcherNumber is the shadow
/// catcher; kAnyObjectNumber stands for any object.
inline constexpr std::uint32_t kCatcherNumber = 255U;
inline constexpr std::uint32_t kAnyObjectNumber = 254U;
/// Two depths belong to the same surface if they differ by less than z times this factor.
inline constexpr float kSameDepth = 0.003F;
/// The colour of a surface is interpolated only between texels that show this surface. If the sum
/// of their weights is below this limit, the colour is unreliable.
inline constexpr float kLeastLookUpWeight = 0.2F;
/// Number of pyramid levels that suffice to fill a one-pixel-wide crack.
inline constexpr int kCrackLevels = 2;
/// EdgeRefiner sorts pixels by contrast into this number of contrast levels.
inline constexpr std::uint32_t kContrastLevels = 64U;

/// One mesh of the virtual scene.
struct alignas(16) SilhouetteMesh {
    Transform object;  ///< T_camera_object, multiplied by the object's scale
    Projection layer;
    float width, height;  ///< size of the layer [px]
    float number;         ///< number of the object
    float cutoff;         ///< points with a smaller alpha are holes
};

/// A picture in which the warp looks up colours. LookUpViews::views[0] is the traced picture; the
/// others are re-rendered pictures.
struct alignas(16) View {
    Transform toView;  ///< T_view_camera
    float share;       ///< share of a re-rendered picture in the displayed colour, [0, 1]
};

/// Plane of a planar shadow catcher, in the layer's camera frame: normal . point = offset [m]. All
/// components are 0 if the shadow catcher is not planar.
struct alignas(16) Plane {
    float x, y, z;
    float offset;
};

/// Numbers of workgroups of an indirect dispatch that processes the entries of a list.
struct alignas(16) DispatchGroups {
    std::uint32_t x, y, z;
    std::uint32_t count;  ///< number of entries in the list
};

struct alignas(16) LookUpViews {
    View views[5];
    Projection projections[2];  ///< [0]: traced picture; [1]: layer and re-rendered pictures
    Plane plane;
    PixelBounds bounds;
    DispatchGroups wanted[6];                ///< workgroups of each level of the hole pyramid
    std::int32_t tracedWidth, tracedHeight;  ///< size of the traced picture [px]
    std::int32_t width, height;              ///< size of the layer [px]
    std::int32_t rerendered, levels;
};

/// A level of the pyramid from which holes are filled.
struct alignas(16) HoleLevel {
    std::int32_t first;  ///< index of the level's first texel in the pyramid
    std::int32_t columns;
    std::int32_t originX, originY;  ///< position of the first texel [texels of this level]
};

struct alignas(16) FillHoles {
    PixelBounds bounds;
    HoleLevel levels[6];    ///< pyramid levels 1 to 6
    std::int32_t width;     ///< width of the layer [px]
    std::int32_t fillsAll;  ///< 1: holes of all sizes are filled; 0: only cracks
    std::int32_t level;     ///< pyramid level that this pass computes
    std::int32_t levelCount;
    std::int32_t rows, rowsBelow;  ///< rows of the computed pyramid level and of the level below
    std::int32_t texels;           ///< number of texels of all pyramid levels
};

/// Parameters for sharpening edge pixels while the camera rests.
struct alignas(16) RefineEdges {
    PixelBounds bounds;
    std::int32_t width;          ///< width of the layer [px]
    std::int32_t shown;          ///< number of edge pixels that were rendered individually
    std::int32_t leastContrast;  ///< pixels below this contrast level are not listed
    std::int32_t mostListed;     ///< largest number of listed pixels
    float renderedShare;         ///< share of the rendered colour in the displayed colour
    float listedShare;           ///< upper limit of (listed pixels / pixels of objects)
};

}  // namespace mfar::params
