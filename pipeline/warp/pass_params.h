#pragma once

#include "base/lens_params.h"
#include "pipeline/composite/pass_params.h"

#include <cstdint>

// Constants and parameters of the shaders warp_*.comp, warp_*.frag and warp_silhouette.vert.
// gles_shaders/params_to_glsl.cmake converts this header to GLSL.
namespace mfar::params {

/// Special object numbers. kCatcherNumber is the shadow catcher in packed surfaces (see
/// warp_surface.glsl). kAnyObjectNumber selects the colours of all objects when pixels are filled.
inline constexpr std::uint32_t kCatcherNumber = 255U;
inline constexpr std::uint32_t kAnyObjectNumber = 254U;
inline constexpr int kSurfaceNumbers = 256;
/// Two depths belong to the same surface if they differ by less than this factor times z.
inline constexpr float kSameDepth = 0.003F;
/// A surface's colour is interpolated only between texels that show this surface; for the
/// shadow catcher, texels that show no surface count, too. The colour is unreliable if the sum of
/// these texels' weights is not above this limit.
inline constexpr float kLeastLookUpWeight = 0.2F;
/// Cracks of one pixel are filled even if HoleFilling leaves larger holes in the surface empty. In
/// this case, only this number of pyramid levels is used, the finest ones.
inline constexpr int kCrackLevels = 2;
inline constexpr std::uint32_t kContrastLevels = 64U;
/// Lists of pixels are processed by rows of this number of workgroups, with 64 entries each. With
/// one row, 65535 workgroups, the most that OpenGL ES guarantees, would process only 4.2 million
/// entries.
inline constexpr std::uint32_t kListColumns = 16U;
inline constexpr std::uint32_t kListRow = 64U * kListColumns;  ///< entries per row

struct alignas(16) SilhouetteMesh {
    Transform object;  ///< T_camera_object, multiplied by the object's scale
    Projection layer;
    float width, height;
    float number;
    float cutoff;  ///< points with a smaller alpha are transparent
};

/// A picture in which the warp looks up colours. The first of LookUpViews::views is the traced
/// picture; the others are re-rendered pictures.
struct alignas(16) View {
    Transform toView;  ///< T_view_camera
    float share;       ///< weight in the displayed colour [0, 1]; unused for the traced picture
};

/// Plane of a planar shadow catcher in the layer's camera frame: normal . point = offset [m]. All
/// values are 0 for other catchers.
struct alignas(16) Plane {
    float x, y, z;
    float offset;
};

/// Indirect dispatch over the entries of a list. x, y, z: number of workgroups.
struct alignas(16) DispatchGroups {
    std::uint32_t x, y, z;
    std::uint32_t count;  ///< length of the list
};

struct alignas(16) LookUpViews {
    View views[5];
    Projection projections[2];  ///< [0]: traced picture; [1]: layer and re-rendered pictures
    Plane plane;
    PixelBounds bounds;
    /// One entry for each level of the pyramid from which missing pixels are filled.
    DispatchGroups wanted[6];
    /// Sizes in pixels of the traced picture and of the layer.
    std::int32_t tracedWidth, tracedHeight;
    std::int32_t width, height;
    std::int32_t rerendered, levels;
    /// 1: the pictures contain the light on objects, to which the paint is applied. 0: they contain
    /// finished colours.
    std::int32_t tracedIsLit, rerenderedIsLit;
    std::int32_t texels;  ///< always 4, see warp_known.glsl
};

/// Parameters of warp_eye_light.frag, which computes how the light on a traced picture's objects
/// looks from a new position of the camera (the eye).
struct alignas(16) EyeLight {
    Row4 axes[3];  ///< rows of the traced picture's R_world_camera
    Row4 eye;      ///< vector from the traced picture's camera to the eye, in the world [m]
    Row4 towardsSun, irradiance;  ///< see MirrorLight
    float least, exposure;
    std::int32_t mirrors;  ///< 1: mirrored light is computed for `eye`; 0: it stays unchanged
};

/// One level of the pyramid from which missing pixels are filled: its position in the array of all
/// levels and in the picture.
struct alignas(16) HoleLevel {
    std::int32_t first;  ///< index of this level's first texel in the array of all levels
    std::int32_t columns;
    std::int32_t originX, originY;  ///< position of the first texel [texels of this level]
};

struct alignas(16) FillHoles {
    PixelBounds bounds;
    HoleLevel levels[6];
    std::int32_t width;
    std::int32_t fillsObjects, fillsCatcher;  ///< 1: fills all missing pixels; 0: only cracks
    std::int32_t level;
    std::int32_t levelCount;
    std::int32_t rows, rowsBelow;  ///< rows of this pyramid level and of the next finer level
    std::int32_t texels;           ///< number of texels of all levels together
};

/// Parameters of warp_edges.comp and warp_sharpen.comp. The first lists the edge pixels that the
/// path tracer will render: those that differ most from their neighbours, in kContrastLevels
/// levels.
struct alignas(16) RefineEdges {
    PixelBounds bounds;
    std::int32_t width;
    std::int32_t shown;          ///< number of edge pixels with a rendered colour
    std::int32_t leastContrast;  ///< pixels with a lower contrast level are never listed
    /// At most `mostListed` pixels are listed, and at most listedShare * (number of object pixels).
    /// But all pixels of the highest contrast level are listed, even beyond both limits.
    std::int32_t mostListed;
    float renderedShare;  ///< opacity of the rendered colours over the warped ones, [0, 1]
    float listedShare;
};

}  // namespace mfar::params
