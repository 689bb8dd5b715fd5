#pragma once

#include "pipeline/composite/lens_projection.h"
#include "pipeline/render/rendered_picture.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

inline constexpr float kFarthestSurface = 1e6F;  ///< [m]: surfaces farther away are ignored

inline constexpr std::uint32_t kUnknownId = 254;  ///< number that no object has

/// Data of a pixel for look-ups during a warp; the texel that the shaders read.
struct WarpSurface {
    float z = 0;          ///< [m]; 0: no surface
    float id = 0;         ///< number of the surface; 0: no surface
    float tolerance = 0;  ///< points whose z differs by less [m] are on the same surface
    float known = 0;      ///< 1: the pixel was rendered, and its colour is that of one surface
};

/// A finished picture that was prepared on the CPU for warping. Any thread may prepare it. Each
/// array is row-major and has camera.size pixels.
struct TracedPicture {
    CameraModel camera;
    RigidTransform T_world_camera;
    std::vector<std::array<std::uint8_t, 4>> picture;  ///< rendered colours; valid where depth is
    std::vector<float> depth;                          ///< z for display [m]; reduced at shadows
                                                       ///< (kShadowLift); 0: no surface
    /// Colour of a single surface. Unless the picture is layered, pixels at an edge get the colour
    /// of the nearest pixels inside the surface. Objects are opaque; the shadow catcher is
    /// premultiplied.
    std::vector<std::array<std::uint8_t, 4>> colour;
    /// Light on objects in the same pixels. Empty if only colours are known.
    std::vector<LightWords> light;
    /// How these pixels mirror the light `mirrors`, multiplied by `exposure`. Empty if unknown.
    std::vector<GlossWords> gloss;
    std::shared_ptr<const MirrorLight> mirrors;
    float exposure = 1;
    bool layered = false;  ///< see RenderedPicture
    std::vector<WarpSurface> surface;
    /// z and number of the surface in one word, in the format of warp_surface.glsl. Unknown pixels
    /// have kUnknownId.
    std::vector<std::uint32_t> packed;
    /// A part of the picture that is not empty. Tiles are used to bound the motion of the picture's
    /// points.
    struct Tile {
        PixelRect pixels;
        std::array<Eigen::Vector2d, 4> rays;  ///< normalised rays of the tile's outer corners
        float nearest, farthest;              ///< z [m]
    };
    std::vector<Tile> tiles;
    PixelRect bounds;  ///< bounds of all tiles; empty: there is no surface
};

/// Throws std::invalid_argument if the camera or the pose is not finite, a side is longer than
/// 16384, or an array has the wrong size. A pixel has no surface if z is not finite, not beyond the
/// near plane, or above 1000 km.
[[nodiscard]] TracedPicture tracedPicture(const RenderedPicture& picture);

/// Colour of a surface, computed from a partly covered pixel at an edge: the colour is divided by
/// the coverage, and alpha becomes opaque.
[[nodiscard]] std::array<std::uint8_t, 4> filled(const std::array<std::uint8_t, 4>& premultiplied);

/// WarpSurface::tolerance of a pixel, computed from the steps of z to neighbours on the same
/// surface. `surface` is row-major and has `size` pixels.
[[nodiscard]] float toleranceAt(std::span<const WarpSurface> surface, Size size, int x, int y);

/// How the points of a traced picture move if the view changes from the picture's own view to
/// another view of the layer.
struct WarpMotion {
    double greatest = 0;  ///< [px]; infinite if a point moves behind the near plane
    PixelRect bounds;     ///< pixels of the other view that show a point
};
[[nodiscard]] WarpMotion motionOf(const TracedPicture& traced, const LensProjection& layer,
                                  const RigidTransform& T_world_camera);

}  // namespace mfar
