#pragma once

#include "pipeline/composite/lens_projection.h"
#include "pipeline/render/rendered_picture.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

inline constexpr float kFarthestSurface = 1e6F;  ///< [m]: anything farther away is ignored

inline constexpr std::uint32_t kUnknownId = 254;  ///< not used by any object

/// Data of a pixel for the look-ups of a warp; the shaders' texel.
struct WarpSurface {
    float z = 0;          ///< [m], 0 = no surface
    float id = 0;         ///< number of the surface, 0 = no surface
    float tolerance = 0;  ///< difference of z up to which a point is on the same surface [m]
    float known = 0;      ///< 1: the pixel was rendered, and its colour comes from one surface
};

/// A finished picture prepared for warping, on the host; any thread may do that. Row-major,
/// view.camera.size pixels each.
struct WarpReference {
    CameraModel camera;
    RigidTransform T_world_camera;
    std::vector<std::array<std::uint8_t, 4>> picture;  ///< as rendered, where depth is valid
    std::vector<float> depth;                          ///< as displayed: z [m], reduced for shadows
                                                       ///< (kShadowLift); 0 = no surface
    /// Colours of single surfaces: at an edge, the colour of the nearest pixels within the surface.
    /// Opaque for objects, premultiplied for the catcher.
    std::vector<std::array<std::uint8_t, 4>> colour;
    /// Of the same pixels, where an object is; empty: colours alone are known.
    std::vector<LightWords> light;
    /// How these pixels mirror `mirrors`, times `exposure`; empty: unknown.
    std::vector<GlossWords> gloss;
    std::shared_ptr<const MirrorLight> mirrors;
    float exposure = 1;
    std::vector<WarpSurface> surface;
    /// z and number in a word, packed as in warp_surface.glsl; kUnknownId where nothing is known.
    std::vector<std::uint32_t> packed;
    /// A part of the picture that is not empty; bounds the motion of its points.
    struct Tile {
        PixelRect pixels;
        std::array<Eigen::Vector2d, 4> rays;  ///< normalised, of the part's outer corners
        float nearest, farthest;              ///< z [m]
    };
    std::vector<Tile> tiles;
    PixelRect bounds;  ///< bounds of all tiles' pixels, empty = no surface
};

/// Throws std::invalid_argument for a camera or pose that is not finite, a size beyond 16384, or
/// fields of another size. Where z is not finite, not beyond the near plane or above 1000 km, there
/// is no surface.
[[nodiscard]] WarpReference warpReference(const RenderedPicture& picture);

/// Colour of one surface from a pixel at an edge: the covered part is extended to the whole pixel.
[[nodiscard]] std::array<std::uint8_t, 4> filled(const std::array<std::uint8_t, 4>& premultiplied);

/// WarpSurface::tolerance of a pixel, from the steps of z to neighbours on the same surface.
/// `surface`: row-major, `size` pixels.
[[nodiscard]] float toleranceAt(std::span<const WarpSurface> surface, Size size, int x, int y);

/// Motion of a reference's points from its own view to another one of the layer.
struct WarpMotion {
    double greatest = 0;  ///< [px], infinite if a point moves behind the near plane
    PixelRect bounds;     ///< pixels of the other view that show any point
};
[[nodiscard]] WarpMotion motionOf(const WarpReference& reference, const LensProjection& layer,
                                  const RigidTransform& T_world_camera);

}  // namespace mfar
