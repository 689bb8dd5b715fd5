#pragma once

#include "pipeline/composite/lens_projection.h"
#include "pipeline/render/rendered_picture.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

inline constexpr float kFarthestSurface = 1e6F;  ///< [m]: surfaces farther away are ignored

/// TracedPicture::packed of a pixel whose surface is unknown. No object has this number.
inline constexpr std::uint32_t kUnknownId = 254;

/// The surface that a pixel of a picture shows, for the warp's look-ups. Shaders read it as a
/// texel.
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
    /// Colours as they were rendered; valid where `depth` is above 0.
    std::vector<std::array<std::uint8_t, 4>> picture;
    /// z for display [m]; 0: no surface. On the shadow catcher it is reduced (see kShadowLift).
    std::vector<float> depth;
    /// Colours for look-ups: each is the colour of a single surface. Unless the picture is layered,
    /// pixels at an edge of a surface get the mean colour of adjacent pixels inside the surface.
    /// Colours of objects are opaque; those of the shadow catcher are premultiplied.
    std::vector<std::array<std::uint8_t, 4>> colour;
    /// Light on the object in each pixel, for look-ups like `colour`. Empty if only colours are
    /// known.
    std::vector<LightWords> light;
    /// How the object in each pixel mirrors distant light, which is `mirrors` times `exposure`.
    /// Empty if unknown.
    std::vector<GlossWords> gloss;
    std::shared_ptr<const MirrorLight> mirrors;
    float exposure = 1;
    bool layered = false;  ///< see RenderedPicture
    std::vector<WarpSurface> surface;
    /// z and number of the surface in one word, in the format of warp_surface.glsl. Unknown pixels
    /// have kUnknownId.
    std::vector<std::uint32_t> packed;
    /// A square part of the picture that shows a surface. motionOf() bounds the motion of the
    /// picture's points by that of the tiles' corners.
    struct Tile {
        PixelRect pixels;
        std::array<Eigen::Vector2d, 4> rays;  ///< normalised rays of the tile's outer corners
        float nearest, farthest;              ///< smallest and largest z in the tile [m]
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
    PixelRect bounds;     ///< pixels of the other view in which points of the picture lie
};
[[nodiscard]] WarpMotion motionOf(const TracedPicture& traced, const LensProjection& layer,
                                  const RigidTransform& T_world_camera);

}  // namespace mfar
