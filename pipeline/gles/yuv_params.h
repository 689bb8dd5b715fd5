#pragma once

#include "base/lens_params.h"

// Parameters for Y U V pictures (picture_from_yuv.frag). gles_shaders/params_to_glsl.cmake converts
// this header to GLSL.
namespace mfar::params {

struct alignas(16) YuvPicture {
    Row4 rows[3];          ///< R, G, B = row . (Y, U, V, 1); all values in [0, 1]
    float texelX, texelY;  ///< 1 / size [1/px]
};

}  // namespace mfar::params
