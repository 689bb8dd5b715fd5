#pragma once

#include "base/lens_params.h"

// Parameters of picture_from_yuv.frag. params_to_glsl.cmake translates this header to GLSL.
namespace mfar::params {

struct alignas(16) YuvPicture {
    /// The rows times (Y, U, V, 1) give R, G and B. All values are in [0, 1].
    Row4 rows[3];
    float texelX, texelY;
};

}  // namespace mfar::params
