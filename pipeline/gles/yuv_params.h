#pragma once

#include "base/lens_params.h"

// Parameters of picture_from_yuv.frag. params_to_glsl.cmake translates this header to GLSL.
namespace mfar::params {

struct alignas(16) YuvPicture {
    Row4 rows[3];  ///< times (Y, U, V, 1) gives R, G and B; all in [0, 1]
    float texelX, texelY;
};

}  // namespace mfar::params
