#pragma once

#include <cstdint>

// Parameters of display_scale.frag. gles_shaders/params_to_glsl.cmake translates this header to
// GLSL.
namespace mfar::params {

struct alignas(16) ScalePicture {
    std::int32_t left, top, width, height;  ///< the picture's rectangle on the screen [px]
    float scaleX, scaleY;                   ///< picture pixels per screen pixel
    float footprintX, footprintY;           ///< sides of the averaged area [picture px]
    std::int32_t pictureWidth, pictureHeight;
    std::int32_t blueFirst;  ///< 1: the output's bytes are B G R; 0: R G B
};

}  // namespace mfar::params
