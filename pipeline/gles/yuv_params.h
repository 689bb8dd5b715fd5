#pragma once

#include "base/lens_params.h"

// Parameters of picture_from_yuv.frag. gles_shaders/params_to_glsl.cmake translates this header for
// the shader.
namespace mfar::params {

struct alignas(16) YuvPicture {
    Row4 rows[3];          ///< R, G and B are the products of these rows with (Y, U, V, 1); all
                           ///< values in [0, 1]
    float texelX, texelY;  ///< 1 / size of the picture [1/px]
};

}  // namespace mfar::params
