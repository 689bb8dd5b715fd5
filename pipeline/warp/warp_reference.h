#pragma once

#include "pipeline/composite/lens_projection.h"
#include "pipeline/render/rendered_picture.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

inline constexpr float kFarthestSurface = 1e6F;  ///< [m]: what is farther is nothing

inline constexpr std::uint32_t kUnknownId = 254;  ///< no object's

/// What the look-up of a warp knows of a pixel; the shaders' texel.
struct WarpSurface {
    float z = 0;          ///< [m], 0 = nothing there
    float id = 0;         ///< number of what is there, 0 = nothing
    float tolerance = 0;  ///< how far another z may be from this one for the same surface [m]
    float known = 0;      ///< 1: the pixel was rendered, and its colour is of one surface
};

/// A finished picture made ready for warping, on the host: any thread may do that. Row-major,
/// view.camera.size pixels each.
struct WarpReference {
    CameraModel camera;
    RigidTransform T_world_camera;
    std::vector<std::array<std::uint8_t, 4>> picture;  ///< as rendered, where there is depth
    std::vector<float> depth;                          ///< as shown: z [m], that of shadows
                                                       ///< lifted; 0 = nothing
    /// Colours of single surfaces: where an edge runs through the pixel, that of the nearest pixels
    /// within. Of an object opaque, of the catcher premultiplied.
    std::vector<std::array<std::uint8_t, 4>> colour;
    /// Of the same pixels, where an object is; empty: colours alone are known.
    std::vector<LightWords> light;
    std::vector<WarpSurface> surface;
    /// z and number in a word, as warp_surface.glsl packs them; kUnknownId where nothing is known.
    std::vector<std::uint32_t> packed;
    /// Where there is anything, in parts, so that the motion of all can be bounded.
    struct Tile {
        PixelRect pixels;
        std::array<Eigen::Vector2d, 4> rays;  ///< normalised, of its outer corners
        float nearest, farthest;              ///< z [m]
    };
    std::vector<Tile> tiles;
    PixelRect bounds;  ///< around all tiles' pixels, empty = nothing
};

/// Throws std::invalid_argument for a camera or pose that is not finite, a size beyond 16384, or
/// fields of another size. A z that is not finite, not beyond the near plane or above 1000 km is
/// taken as nothing.
[[nodiscard]] WarpReference warpReference(const RenderedPicture& picture);

/// Colour of one surface from a pixel that an edge runs through: what covers it fills it.
[[nodiscard]] std::array<std::uint8_t, 4> filled(const std::array<std::uint8_t, 4>& premultiplied);

/// Row-major, `size` pixels: WarpSurface::tolerance of the pixel, from the steps of z to neighbours
/// of the same surface.
[[nodiscard]] float toleranceAt(std::span<const WarpSurface> surface, Size size, int x, int y);

/// How the points of a reference move between its own view and another one of the layer.
struct WarpMotion {
    double greatest = 0;  ///< [px], infinite where some point leaves the space before the camera
    PixelRect bounds;     ///< pixels of the other view that show any of it
};
[[nodiscard]] WarpMotion motionOf(const WarpReference& reference, const LensProjection& layer,
                                  const RigidTransform& T_world_camera);

}  // namespace mfar
