#pragma once

#include "base/lens_params.h"

// Pictures in Y U V: picture_from_yuv.frag. Shaders read this header, too:
// gles_shaders/params_to_glsl.cmake.
namespace mfar::params {

struct alignas(16) YuvPicture {
    Row4 rows[3];          ///< R, G, B = row . (Y, U, V, 1), all in [0, 1]
    float texelX, texelY;  ///< 1 / size [1/px]
};

}  // namespace mfar::params
