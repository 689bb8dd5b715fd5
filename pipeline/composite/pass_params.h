#pragma once

#include "base/lens_params.h"
#include "pipeline/engine/params/layer.h"

#include <cstdint>

// Parameters of the preview's shaders. The warp's shaders use some of them too.
// params_to_glsl.cmake translates this header to GLSL.
namespace mfar::params {

/// The three rows of the 3x4 matrix of a rotation and a translation. They transform points [m]
/// between coordinate systems. The rotation may include a scale factor.
struct alignas(16) Transform {
    Row4 rows[3];
};

struct alignas(16) Projection {
    Lens lens;
    float rim;
    float rimRadial;
    float nearPlane;
};

struct alignas(16) PixelBounds {
    std::int32_t x0, y0, x1, y1;
};

struct alignas(16) Colour {
    float red, green, blue;
};

struct alignas(16) PreviewObject {
    Transform object;
    Projection projection;
    Colour colours[2];
    float width, height, depth;  ///< size of the object [m]
    float squares;
    float lightX, lightY, lightZ;  ///< unit vector towards the light, in camera coordinates
    float ambient;
    float targetWidth, targetHeight;  ///< size of the drawn picture [px]
    /// Limits of the unit shape (side length 1), with a margin for rounding: largest coordinate,
    /// and largest squared distance of a point from the centre.
    float reach, squaredRadius;
};

}  // namespace mfar::params
