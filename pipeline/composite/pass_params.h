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
    /// `targetWidth` and `targetHeight` are in pixels. All other lengths are in metres.
    Transform object;
    Projection projection;
    Colour colours[2];
    float width, height, depth;
    float squares;
    float lightX, lightY, lightZ;  ///< unit vector towards the light, in camera coordinates
    float ambient;
    float targetWidth, targetHeight;
    /// Limits of the unit shape: largest coordinate, and squared distance of its corners from the
    /// centre.
    float reach, squaredRadius;
};

}  // namespace mfar::params
