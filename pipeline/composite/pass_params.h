#pragma once

#include "base/lens_params.h"
#include "pipeline/engine/params/layer.h"

#include <cstdint>

// Parameters of the preview's shaders (preview.vert, preview.frag), and definitions shared with the
// warp. gles_shaders/params_to_glsl.cmake translates this header for the shaders.
namespace mfar::params {

/// Transforms points [m] from one coordinate system to another: rows of rotation and translation.
/// May include a scale, which is applied first.
struct alignas(16) Transform {
    Row4 rows[3];
};

/// A LensProjection in single precision.
struct alignas(16) Projection {
    Lens lens;
    float rim;        ///< radius of the outermost ray for which the lens model is valid
    float rimRadial;  ///< radial factor of the distortion at the rim
    float nearPlane;  ///< [m]
};

/// Pixels x0 <= x < x1, y0 <= y < y1.
struct alignas(16) PixelBounds {
    std::int32_t x0, y0, x1, y1;
};

struct alignas(16) Colour {
    float red, green, blue;  ///< display values, [0, 1]
};

/// One virtual object of the preview.
struct alignas(16) PreviewObject {
    Transform object;  ///< T_video_object
    Projection projection;
    Colour colours[2];                ///< colours of the checkerboard's squares
    float width, height, depth;       ///< size of the object [m]
    float squares;                    ///< number of squares along each side
    float lightX, lightY, lightZ;     ///< unit vector towards the light, in camera coordinates
    float ambient;                    ///< share of the light that comes from all directions, [0, 1]
    float targetWidth, targetHeight;  ///< [px]
    float reach, squaredRadius;       ///< limits of the unit shape: largest coordinate, and squared
                                      ///< distance of its corners from the centre
};

}  // namespace mfar::params
