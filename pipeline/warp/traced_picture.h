#pragma once

#include "pipeline/composite/lens_projection.h"
#include "pipeline/render/rendered_picture.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

inline constexpr float kFarthestSurface = 1e6F;  ///< [m]; surfaces farther away are ignored

/// Value of TracedPicture::packed for a pixel with an unknown colour (WarpSurface::known is 0). No
/// object has this number.
inline constexpr std::uint32_t kUnknownId = 254;

/// The surface shown by a pixel. Shaders read it as a texel.
struct WarpSurface {
    float z = 0;          ///< [m]; 0 if there is no surface
    float id = 0;         ///< object number; 0 if there is no surface
    float tolerance = 0;  ///< points whose z differs by less are on the same surface [m]
    /// 0: the colour is unknown, because it is a mixture of surfaces or was never rendered. 1: it
    /// is known; on objects, it can still be a mixture if no adjacent pixel has a better colour.
    float known = 0;
};

/// Returns the surface's entry of TracedPicture::packed.
[[nodiscard]] std::uint32_t packedSurface(const WarpSurface& surface);

/// A finished picture, prepared on the CPU for warping. Any thread may prepare it. Each array is
/// row-major and has camera.size pixels.
struct TracedPicture {
    CameraModel camera;
    RigidTransform T_world_camera;
    /// Colours as rendered; valid where `depth` is above 0.
    std::vector<std::array<std::uint8_t, 4>> picture;
    /// z with which the layer is drawn [m]; 0: no surface. On the shadow catcher it is smaller than
    /// the true z (see kShadowLift).
    std::vector<float> depth;
    /// Colours for look-ups. At edges, a colour in `picture` is a mixture of surfaces, unless the
    /// picture is layered (see RenderedPicture::layered). In `colour`, an edge pixel has the mean
    /// colour of adjacent unmixed pixels of its own surface, if there are any. Colours of objects
    /// are opaque. Colours of the shadow catcher are premultiplied.
    std::vector<std::array<std::uint8_t, 4>> colour;
    /// Light on each pixel's object, for look-ups. Empty if only colours are known.
    std::vector<LightWords> light;
    /// How the surface in each pixel mirrors distant light (sky and sun). Unknown for moving
    /// objects; empty if unknown for all pixels. The distant light is stored in `mirrors` and must
    /// be multiplied by the factor `exposure`.
    std::vector<GlossWords> gloss;
    std::shared_ptr<const MirrorLight> mirrors;
    float exposure = 1;
    bool layered = false;
    /// T_world_object of the scene's objects in this picture. Empty if none of them moves.
    std::vector<RigidTransform> poses;
    std::vector<WarpSurface> surface;
    /// z and object number in one word, in the format of warp_surface.glsl.
    std::vector<std::uint32_t> packed;
    /// A part of the picture that shows a surface, at most 16x16 pixels. When the view changes, the
    /// point that moves farthest in the picture is a corner of the tile, at the depth `nearest` or
    /// `farthest`.
    struct Tile {
        PixelRect pixels;
        std::array<Eigen::Vector2d, 4> rays;  ///< normalised rays of the outer corners
        float nearest, farthest;              ///< smallest and largest z [m]
    };
    std::vector<Tile> tiles;
    PixelRect bounds;
};

/// Throws std::invalid_argument if the camera or the pose is not finite, a focal length is not
/// above 0, a side is not from 1 to 16384 px, or an array has the wrong size. A pixel
/// has a surface only if its id is not 0, and its z is beyond the near plane and below 1000 km.
[[nodiscard]] TracedPicture tracedPicture(const RenderedPicture& picture);

/// Divides a partly covered pixel's colour by its coverage and makes it opaque.
[[nodiscard]] std::array<std::uint8_t, 4> filled(const std::array<std::uint8_t, 4>& premultiplied);

/// Returns WarpSurface::tolerance of a pixel, computed from the differences of z to its neighbours.
/// `surface` is row-major and has `size` pixels.
[[nodiscard]] float toleranceAt(std::span<const WarpSurface> surface, Size size, int x, int y);

/// Motion of a traced picture's points from the picture's own view to another view of the layer.
struct WarpMotion {
    /// Largest motion of a point [px]. Infinite if a point comes nearer to the camera than the near
    /// plane, or if the picture shows a surface and its size differs from the layer's.
    double greatest = 0;
    PixelRect bounds;  ///< bounds of the points in the other view
};
[[nodiscard]] WarpMotion motionOf(const TracedPicture& traced, const LensProjection& layer,
                                  const RigidTransform& T_world_camera);

}  // namespace mfar
